// SPDX-License-Identifier: MIT
/// \file
/// Reads a landmark file whose ids are those of the atlas.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "risorius/rig/atlas.h"
#include "risorius/rig/rig_description.h"

namespace risorius::fitting {

/// Throws Error for an id that the atlas does not know.
std::map<std::string, rig::Landmark> read_atlas_named_landmarks(
    const std::filesystem::path& file, const std::vector<rig::AtlasLandmark>& atlas);

inline constexpr double kLeastConfidence = 0.5;  ///< of a landmark that a program has placed

/// Removes landmarks in which the program that placed them has little confidence: the atlas places them. Returns a note. Throws
/// Error for one that no rig can do without.
std::vector<std::string> leave_out_unsure(std::map<std::string, rig::Landmark>& landmarks,
                                          const std::filesystem::path& file);

}  // namespace risorius::fitting
