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

}  // namespace risorius::fitting
