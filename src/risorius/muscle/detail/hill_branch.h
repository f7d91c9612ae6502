// SPDX-License-Identifier: MIT
/// \file
/// The common part of the force-velocity curves of Zajac and Thelen: Hill's hyperbola for shortening. Near the maximum speed it
/// is replaced by a cubic that falls to zero force.
///
///   v   speed / maximum shortening speed, v < 0 shortens        a   a / F0 of Hill's equation
///   f   (1 + v) / (1 - v / a) from -0.9 to 0; a cubic from there to f = 0 with slope 0 at -1.1
#pragma once

#include <vector>

#include "risorius/muscle/detail/curve.h"

namespace risorius::muscle {

/// Pieces up to v = 0, where the value is 1 and the slope is 1 + 1/a.
std::vector<CurvePiece> hill_branch(double a);

/// Lengthening: max - (max - 1) / (1 + rate v), starting at v = 0.
CurvePiece lengthening_piece(double max, double rate);

}  // namespace risorius::muscle
