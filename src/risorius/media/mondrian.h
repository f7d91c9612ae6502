// SPDX-License-Identifier: MIT
/// \file
/// Mondrian patterns: random rectangles over the whole picture, which keep what the other eye sees from awareness when they change
/// about ten times a second.
///
/// Source: Tsuchiya & Koch 2005, Nature Neuroscience 8(8).
#pragma once

#include "risorius/core/image.h"

namespace risorius::media {

struct Mondrian {
    double face_px = 100;  ///< sides of rectangles are 3 to 25 % of this, log-uniform
    bool grey = true;      ///< else each of red, green and blue is drawn
    /// Of relative luminance over the picture; the deviation is as large as black and white allow
    double mean = 0.3, sd = 0.1;
    unsigned seed = 1;
};

/// Draws the pattern over all of an opaque picture.
void draw(const Mondrian& mondrian, Image& image);

}  // namespace risorius::media
