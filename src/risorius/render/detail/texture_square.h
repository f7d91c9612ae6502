// SPDX-License-Identifier: MIT
/// \file
/// Helpers for making a square picture on texture coordinates. Alpha is 0 where the picture is still empty.
#pragma once

#include "risorius/core/image.h"
#include "risorius/core/types.h"

namespace risorius::render {

std::uint8_t srgb_byte(double linear);

/// Extends the colours a few texels beyond the border of the covered area, so that filtering shows no seam. Texels farther away
/// get the colour `otherwise`, sRGB 0..1.
void fill_uncovered(Image& image, const Vec3& otherwise);

/// Returns the mean of the covered texels, sRGB 0..1; black if there are none.
Vec3 mean_colour(const Image& image);

}  // namespace risorius::render
