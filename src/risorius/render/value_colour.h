// SPDX-License-Identifier: MIT
/// \file
/// The colour of a quantity: from pale through orange and red to a dark purple as it grows; of one that has a sign, from dark
/// blue through grey at zero to a light yellow.
///
/// CIE lightness changes evenly and in one direction, so more can be told from less in grey and without colour vision too.
#pragma once

#include "risorius/core/types.h"

namespace risorius::render {

/// Linear light, sRGB primaries, 0..1; beyond the range its ends. The range has a sign when `from` < 0 < `to`.
Vec3 value_colour(double value, double from, double to);

/// Where there is no value.
Vec3 no_value_colour();

/// Encoded as in an image, 0..1.
Vec3 srgb_of(const Vec3& linear);

}  // namespace risorius::render
