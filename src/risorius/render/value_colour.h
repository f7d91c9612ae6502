// SPDX-License-Identifier: MIT
/// \file
/// Colour maps for quantities: from pale through orange and red to dark purple, and for signed quantities from dark blue through
/// grey at zero to light yellow.
///
/// CIE lightness changes evenly and in one direction, so values can also be compared in greyscale and without colour vision.
#pragma once

#include "risorius/core/types.h"

namespace risorius::render {

/// Returns the colour of a value in linear light with sRGB primaries, 0..1. Values outside [from, to] are clamped. The map for
/// signed quantities is used when `from` < 0 < `to`.
Vec3 value_colour(double value, double from, double to);

/// The colour of a missing value, linear light.
Vec3 no_value_colour();

/// Encodes linear light as sRGB, 0..1.
Vec3 srgb_of(const Vec3& linear);

}  // namespace risorius::render
