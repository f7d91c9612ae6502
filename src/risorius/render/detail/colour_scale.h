// SPDX-License-Identifier: MIT
/// \file
/// The colour scale in the upper left corner of a picture: its name, and a bar between two numbers.
#pragma once

#include <functional>
#include <string>

#include "risorius/core/image.h"
#include "risorius/render/offscreen_view.h"

namespace risorius::render {

struct ColourScale {
    std::string name, from, to;
    /// Linear light as displayed; 0 and 1 are the ends of the bar
    std::function<Vec3(double fraction)> colour;
};

/// Draws the scale. Its size follows the smaller side of the picture; text that would be too small to read is omitted.
void draw_colour_scale(const ColourScale& scale, const Background& background, Image& image);

/// The scale of muscle activation, with muscles in uniform light under the skin of the face.
ColourScale activation_scale(const Appearance& appearance);
ColourScale values_scale(const SkinValues& values);

}  // namespace risorius::render
