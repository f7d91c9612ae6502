// SPDX-License-Identifier: MIT
/// \file
/// Pictures on texture coordinates during their construction: alpha is 0 where nothing lies yet.
#pragma once

#include "risorius/core/image.h"
#include "risorius/core/types.h"

namespace risorius::render {

std::uint8_t srgb_byte(double linear);

/// Colours grow over the border of what is covered, so that filtering finds no seam; farther off is `otherwise`, sRGB 0..1.
void fill_uncovered(Image& image, const Vec3& otherwise);

/// Of what is covered, sRGB 0..1; black where nothing is.
Vec3 mean_colour(const Image& image);

}  // namespace risorius::render
