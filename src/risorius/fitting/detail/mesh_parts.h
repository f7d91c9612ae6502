// SPDX-License-Identifier: MIT
/// \file
/// Prepares the groups of a user's mesh before their roles are guessed: materials inside of a group, both eyeballs in one group,
/// and a whole body below the head.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "risorius/geom/polygon_mesh.h"

namespace risorius::fitting {

/// Splits groups whose materials say different parts, and those that `given` names. The rig can name such parts, see
/// geom/mesh_groups.h, so that the mesh need not be written anew.
void split_materials(geom::PolygonMesh& mesh,
                     const std::map<std::string, std::vector<std::string>>& given);

/// Divides groups of eyes, corneas and lashes that have pieces on both sides into "GROUP_l" and "GROUP_r". Groups in `given` stay
/// as they are. `left_of` is positive for points to the subject's left. Returns messages; empty when nothing was divided.
std::vector<std::string> split_sides(geom::PolygonMesh& mesh,
                                     const std::map<std::string, std::vector<std::string>>& given,
                                     const std::function<double(const Vec3& mesh_units)>& left_of);

/// Name of the group with the faces of a body below the head
inline constexpr const char* kBodyGroup = "body_below";

/// Moves faces of `skin_groups` far below the chin into the group kBodyGroup, when the skin is longer than that of a head with
/// shoulders. `to_head` maps mesh units to the head frame, m; `chin` is in the head frame; `size`: this head over the average
/// adult. Returns the number of faces moved.
int hide_body(geom::PolygonMesh& mesh, const std::vector<std::string>& skin_groups,
              const std::function<Vec3(const Vec3&)>& to_head, const Vec3& chin, double size);

}  // namespace risorius::fitting
