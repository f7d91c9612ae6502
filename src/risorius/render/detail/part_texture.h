// SPDX-License-Identifier: MIT
/// \file
/// Textures of eyes, teeth and other moist parts: their materials rendered onto their texture coordinates.
#pragma once

#include <vector>

#include "risorius/core/image.h"
#include "risorius/render/detail/materials.h"

namespace risorius::render {

/// Returns a square picture in sRGB of the material kEye, kTeeth, kGums, kTongue or kMouth. Alpha is 0 where no surface of the
/// material lies. Where both eyes use the same texture coordinates, the left eye is drawn. `crown_height`: see
/// OffscreenView::part_texture(). The context must be current.
Image unfold_part(const Scene& scene, const Materials& materials, Material material, int side_px,
                  const std::vector<double>& crown_height);

}  // namespace risorius::render
