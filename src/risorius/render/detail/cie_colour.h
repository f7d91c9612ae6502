// SPDX-License-Identifier: MIT
/// \file
/// Perceptual colours.
#pragma once

#include "risorius/core/types.h"

namespace risorius::render {

/// Linear light, sRGB primaries, of CIE L*C*h (D65); clipped to the gamut.
Vec3 linear_of_lch(double lightness, double chroma, double hue_deg);

}  // namespace risorius::render
