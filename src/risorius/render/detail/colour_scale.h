// SPDX-License-Identifier: MIT
/// \file
/// The colour scale in the upper left corner of a picture: a bar between two numbers, with its name.
#pragma once

#include <functional>
#include <string>

#include "risorius/core/image.h"
#include "risorius/render/offscreen_view.h"

namespace risorius::render {

struct ColourScale {
    std::string name, from, to;
    std::function<Vec3(double fraction)> colour;  ///< as it is seen, linear; 0 and 1 are the ends
};

/// Sizes follow the smaller side of the picture; text that would be too small to read is left out.
void draw_colour_scale(const ColourScale& scale, const Background& background, Image& image);

/// Of muscles in uniform light under the skin of the face.
ColourScale activation_scale(const Appearance& appearance);
ColourScale values_scale(const SkinValues& values);

}  // namespace risorius::render
