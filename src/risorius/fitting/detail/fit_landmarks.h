// What `fit` asks of a file of landmarks before it believes them: all that are needed, on the skin, left on the left, and
// each where the others put it.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "risorius/geom/polygon_mesh.h"
#include "risorius/rig/head.h"
#include "risorius/rig/landmark_check.h"

namespace risorius::fitting {

/// All in mesh units unless said otherwise. Every function throws Error naming the landmark, with expected and found.
using LandmarkPositions = std::map<std::string, Vec3>;

/// For messages: "ch_l" "ch_r", in quotes.
std::string quoted_list(const std::vector<std::string>& ids);

/// Where the landmarks of the rig are, the required ones among them.
LandmarkPositions landmark_positions(const rig::RigDescription& rig, const geom::PolygonMesh& mesh,
                                     const std::filesystem::path& file);

/// m, dm, cm, mm, inch or foot, whichever makes a head of adult size.
double unit_from_landmarks(const LandmarkPositions& landmarks, const rig::Atlas& atlas);

/// Left and right exchanged, two in one place, all in one place, eyes closed: mistakes that look like another below.
void check_sides(const LandmarkPositions& landmarks, const rig::Atlas& atlas,
                 const std::filesystem::path& file);

/// Those far from the skin are refused, those off it and those that the others contradict become notes; a required one
/// that the others contradict badly is refused.
std::vector<std::string> check_places(const rig::Head& head, const LandmarkPositions& landmarks,
                                      const rig::Atlas& atlas, const std::filesystem::path& file);

/// Landmarks that were not given, in the order of how many points of muscles are placed by them.
std::vector<std::string> worth_giving(const rig::Head& head, const rig::Atlas& atlas);

}  // namespace risorius::fitting
