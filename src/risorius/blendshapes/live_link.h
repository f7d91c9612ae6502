// SPDX-License-Identifier: MIT
/// \file
/// A script as weights of the 52 shapes of ARKit, without making the shapes.
#pragma once

#include <filesystem>
#include <string>

#include "risorius/scene/rig_files.h"

namespace risorius::blendshapes {

/// Returns the table of Live Link Face, one row per frame of the script, see live_link_table(). Builds a face of `quality`
/// (face::quality_named()). Throws Error when the script cannot be used or the rig's tables lack the shapes.
std::string live_link_of_script(const std::filesystem::path& script, const scene::RigFiles& files,
                                const std::string& quality);

}  // namespace risorius::blendshapes
