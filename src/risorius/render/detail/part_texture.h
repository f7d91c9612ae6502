// SPDX-License-Identifier: MIT
/// \file
/// Textures of eyes, teeth and other moist parts: their materials, drawn on their texture coordinates.
#pragma once

#include <vector>

#include "risorius/core/image.h"
#include "risorius/render/detail/materials.h"

namespace risorius::render {

/// A square picture in sRGB, alpha 0 where no surface of the material with texture coordinates lies: kEye, kTeeth, kGums, kTongue or
/// kMouth. Where both eyes lie one has the left. `crown_height` as OffscreenView::part_texture() has it. The context must be current.
Image unfold_part(const Scene& scene, const Materials& materials, Material material, int side_px,
                  const std::vector<double>& crown_height);

}  // namespace risorius::render
