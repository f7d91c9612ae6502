// SPDX-License-Identifier: MIT
/// \file
/// Checks of a landmark file before a fit: all required landmarks are there, they lie on the skin, left ones on the left, and each where
/// the others predict it.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "risorius/geom/polygon_mesh.h"
#include "risorius/rig/head.h"
#include "risorius/rig/landmark_check.h"

namespace risorius::fitting {

/// All in mesh units unless stated. Every function throws Error that names the landmark, the expected and the found.
using LandmarkPositions = std::map<std::string, Vec3>;

/// For messages: "ch_l" "ch_r", in quotes.
std::string quoted_list(const std::vector<std::string>& ids);

/// Positions of the rig's landmarks; the required ones must be among them.
LandmarkPositions landmark_positions(const rig::RigDescription& rig, const geom::PolygonMesh& mesh,
                                     const std::filesystem::path& file);

/// Metres per unit: m, dm, cm, mm, inch or foot, whichever gives a head of adult size.
double unit_from_landmarks(const LandmarkPositions& landmarks, const rig::Atlas& atlas);

/// Refuses files with left and right exchanged, two landmarks or all of them in one place, or closed eyes, since later checks would report
/// something else.
void check_sides(const LandmarkPositions& landmarks, const rig::Atlas& atlas,
                 const std::filesystem::path& file);

/// Refuses landmarks far from the skin, and required ones that the others strongly contradict. Returns notes for those a little off the
/// skin and those that the others contradict.
std::vector<std::string> check_places(const rig::Head& head, const LandmarkPositions& landmarks,
                                      const rig::Atlas& atlas, const std::filesystem::path& file);

/// Landmarks that were not given, sorted by how many points of muscles depend on them.
std::vector<std::string> worth_giving(const rig::Head& head, const rig::Atlas& atlas);

}  // namespace risorius::fitting
