// SPDX-License-Identifier: MIT
/// \file
/// The fibres of a muscle as a repeating texture: s runs across the fibres, t along them.
#pragma once

#include "risorius/render/detail/gl.h"

namespace risorius::render {

constexpr double kFibreTileAcross_m = 0.071, kFibreTileAlong_m = 0.8;

/// Makes the texture. Red: height of the fibre bundles, which are about a millimetre wide, and of the strands in them, 0..1.
/// Green: slope of this height across the fibres, with 0.5 for zero. Blue: height of the strands alone, 0..1.
GLuint make_fibres();

}  // namespace risorius::render
