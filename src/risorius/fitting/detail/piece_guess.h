// SPDX-License-Identifier: MIT
/// \file
/// Identifies the separate pieces of a mesh that has no groups, by their position: eyes behind the lids, teeth and tongue behind
/// the lips.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "risorius/geom/polygon_mesh.h"

namespace risorius::fitting {

/// Moves the faces of pieces that are not skin into groups "eye_l", "eye_r", "teeth", "tongue", "other". `to_head` maps mesh
/// units to the head frame, m. `landmarks` are in the head frame. `size`: this head over the average adult. Returns messages
/// about the named pieces; empty when the mesh has several groups or only one piece.
std::vector<std::string> group_pieces(geom::PolygonMesh& mesh,
                                      const std::function<Vec3(const Vec3&)>& to_head,
                                      const std::map<std::string, Vec3>& landmarks, double size);

}  // namespace risorius::fitting
