// SPDX-License-Identifier: MIT
/// \file
/// How near to equilibrium the poses of a fit are found.
#pragma once

namespace risorius::fitting {

/// Tolerance of the equilibria, m: a thousandth of the way of most landmarks.
inline constexpr double kFitTolerance_m = 5e-6;

}  // namespace risorius::fitting
