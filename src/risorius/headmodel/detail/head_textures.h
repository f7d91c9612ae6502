// SPDX-License-Identifier: MIT
/// \file
/// Textures and material library of an exported head for other programs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "risorius/render/scene.h"

namespace risorius::headmodel {

/// The name of the library, for headmodel::write_head().
constexpr const char* kTextureLibrary = "head.mtl";

/// Writes skin.png (with the wall of the mouth) of this width and height, and eyes.png, teeth.png, gums.png, tongue.png and lashes.png of
/// half of it, and the library. `crown_height`: that of HeadModel. Returns the names of the files. Throws Error for a size outside of 256..4096.
std::vector<std::string> write_head_textures(const render::Scene& scene, int side_px,
                                             const std::vector<double>& crown_height,
                                             const std::filesystem::path& folder);

/// Returns the text of the library alone, with one material for each group of the head. Lashes have the colour of the hair (sRGB
/// 0..1).
std::string texture_library(const Vec3& hair_tone);

}  // namespace risorius::headmodel
