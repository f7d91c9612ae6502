// SPDX-License-Identifier: MIT
/// \file
/// The colour scale in the upper left corner of a picture. It shows its name and a bar of colours between two numbers.
#pragma once

#include <functional>
#include <string>

#include "risorius/core/image.h"
#include "risorius/render/offscreen_view.h"

namespace risorius::render {

struct ColourScale {
    std::string name, from, to;
    /// Colour in linear light, as displayed, at a fraction of the length of the bar, 0..1
    std::function<Vec3(double fraction)> colour;
};

/// Draws the scale. Its size follows the smaller side of the picture; text that would be too small to read is omitted.
void draw_colour_scale(const ColourScale& scale, const Background& background, Image& image);

/// Returns the scale of muscle activation. Its colours are those of muscles in uniform light, seen through the skin of this face.
ColourScale activation_scale(const Appearance& appearance);
ColourScale values_scale(const SkinValues& values);

}  // namespace risorius::render
