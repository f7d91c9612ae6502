// SPDX-License-Identifier: MIT
/// \file
/// Short texts in pictures: names and numbers in letters of constant stroke width, antialiased, the same on every machine.
///
/// Letters, digits and the marks . , : ; - + / % ( ) _ = ' of ASCII; anything else shows as a box.
#pragma once

#include <string_view>

#include "risorius/core/image.h"
#include "risorius/core/types.h"

namespace risorius::render {

struct TextStyle {
    double height_px = 12;  ///< of a capital
    double ink = 0.08;      ///< grey, sRGB: 0 black, 1 white
    double rim = 0;  ///< opacity of a rim of the other tone, so that it can be read on anything
};

/// Of the height of a capital.
double text_width(std::string_view text);

/// `at`: left end of the baseline, px from the upper left corner. What does not fit is cut off.
void write_text(std::string_view text, const Vec2& at, const TextStyle& style, Image& image);

}  // namespace risorius::render
