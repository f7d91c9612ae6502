// SPDX-License-Identifier: MIT
/// \file
/// Conversion from CIE L*C*h to linear RGB.
#pragma once

#include "risorius/core/types.h"

namespace risorius::render {

/// Linear light with sRGB primaries for a colour in CIE L*C*h (D65), clipped to the gamut.
Vec3 linear_of_lch(double lightness, double chroma, double hue_deg);

}  // namespace risorius::render
