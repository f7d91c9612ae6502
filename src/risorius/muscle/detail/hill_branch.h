// SPDX-License-Identifier: MIT
/// \file
/// What the force-velocity curves of Zajac and Thelen share: Hill's hyperbola for shortening, which leaves for zero force
/// around the greatest speed.
///
///   v   speed / greatest shortening speed, v < 0 shortens        a   a / F0 of Hill's equation
///   f   (1 + v) / (1 - v / a) from -0.9 to 0; a cubic from there to f = 0 with slope 0 at -1.1
#pragma once

#include <vector>

#include "risorius/muscle/detail/curve.h"

namespace risorius::muscle {

/// Pieces up to v = 0, where the value is 1 and the slope 1 + 1/a.
std::vector<CurvePiece> hill_branch(double a);

/// Lengthening: most - (most - 1) / (1 + rate v), counted from 0.
CurvePiece lengthening_piece(double max, double rate);

}  // namespace risorius::muscle
