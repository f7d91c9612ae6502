// SPDX-License-Identifier: MIT
/// \file
/// Checks of a landmark file before a fit: all required landmarks exist, landmarks lie on the skin, left ones lie on the left,
/// and each lies where the others predict it.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "risorius/geom/polygon_mesh.h"
#include "risorius/rig/head.h"
#include "risorius/rig/landmark_check.h"

namespace risorius::fitting {

/// Positions by id, in mesh units unless stated otherwise. Every function here throws Error naming the landmark, what was
/// expected and what was found.
using LandmarkPositions = std::map<std::string, Vec3>;

/// Returns a list of ids in quotes for messages: "ch_l" "ch_r".
std::string quoted_list(const std::vector<std::string>& ids);

/// Converts points that are given in coordinates of the mesh's file, which may state a unit and axes (FBX, COLLADA), to those of
/// the mesh as it was read. Returns messages. Throws Error for numbers of vertices when the mesh is not in the order of its file.
std::vector<std::string> take_file_coordinates(std::map<std::string, rig::Landmark>& landmarks,
                                               const geom::PolygonMesh& mesh,
                                               const std::filesystem::path& mesh_file,
                                               const std::filesystem::path& file);

/// Returns the positions of the rig's landmarks. Throws Error when a required one is missing.
LandmarkPositions landmark_positions(const rig::RigDescription& rig, const geom::PolygonMesh& mesh,
                                     const std::filesystem::path& file);

/// Returns the metres per unit of the mesh. The unit is the one of m, dm, cm, mm, inch and foot in which the head has the size of
/// an adult's.
double unit_from_landmarks(const LandmarkPositions& landmarks, const rig::Atlas& atlas);

/// Rejects files with left and right exchanged, with two or all landmarks in one place, or with closed eyes. These are checked
/// first, because later checks would report something misleading.
void check_sides(const LandmarkPositions& landmarks, const rig::Atlas& atlas,
                 const std::filesystem::path& file);

/// Rejects landmarks far from the skin, and required ones that strongly contradict the others. Returns notes about landmarks that
/// are slightly off the skin or contradict the others.
std::vector<std::string> check_places(const rig::Head& head, const LandmarkPositions& landmarks,
                                      const rig::Atlas& atlas, const std::filesystem::path& file);

/// Returns the missing landmarks, sorted by the number of muscle points that depend on them, largest first.
std::vector<std::string> worth_giving(const rig::Head& head, const rig::Atlas& atlas);

}  // namespace risorius::fitting
