// SPDX-License-Identifier: MIT
/// \file
/// Short texts in pictures in an antialiased stroke font, which draws the same pixels on every machine.
///
/// The font has the ASCII letters, digits and the marks . , : ; - + / % ( ) _ = ', and the letters of Western Europe and of Czech
/// that have a sign above them. The text is UTF-8. Any other character is drawn as a box.
#pragma once

#include <string_view>

#include "risorius/core/image.h"
#include "risorius/core/types.h"

namespace risorius::render {

struct TextStyle {
    double height_px = 12;  ///< height of a capital letter
    double ink = 0.08;      ///< grey, sRGB: 0 black, 1 white
    /// Opacity 0..1 of an outline in the opposite tone, which makes the text readable on any background
    double rim = 0;
};

/// Returns the width of a text as a multiple of TextStyle::height_px, the height of a capital letter.
double text_width(std::string_view text);

/// Draws the text. `at`: left end of the baseline, px from the upper left corner of the image. Text outside the image is cut off.
void write_text(std::string_view text, const Vec2& at, const TextStyle& style, Image& image);

}  // namespace risorius::render
