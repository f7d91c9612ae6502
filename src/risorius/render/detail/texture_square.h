// SPDX-License-Identifier: MIT
/// \file
/// Pictures on texture coordinates while they are made: alpha is 0 where they are still empty.
#pragma once

#include "risorius/core/image.h"
#include "risorius/core/types.h"

namespace risorius::render {

std::uint8_t srgb_byte(double linear);

/// Extends colours over the border of the covered area, so that filtering shows no seam. Farther texels become `otherwise`, sRGB
/// 0..1.
void fill_uncovered(Image& image, const Vec3& otherwise);

/// Mean of the covered texels, sRGB 0..1; black if there are none.
Vec3 mean_colour(const Image& image);

}  // namespace risorius::render
