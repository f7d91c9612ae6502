// SPDX-License-Identifier: MIT
/// \file
/// The fibres of a muscle as a repeating texture: s across them, t along them.
#pragma once

#include "risorius/render/detail/gl.h"

namespace risorius::render {

constexpr double kFibreTileAcross_m = 0.071, kFibreTileAlong_m = 0.8;

/// Red: height of the bundles, about a millimetre wide, and their strands, 0..1; green: its slope across, about 0.5; blue: the
/// strands alone.
GLuint make_fibres();

}  // namespace risorius::render
