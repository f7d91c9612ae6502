// SPDX-License-Identifier: MIT
/// \file
/// A quarter of an elliptic ring under pressure: the thick plate LE10 of NAFEMS.
///
///   inner edge (x / 2)^2 + y^2 = 1, outer edge (x / 3.25)^2 + (y / 2.75)^2 = 1, thickness 0.6, all m; E = 210 GPa, nu = 0.3
///   pressure 1 MPa on the upper face; symmetric in x and y; the outer edge keeps x and y, and its middle line z
///
/// Published: sigma_yy = -5.38 MPa at (2, 0) of the upper face.
///
/// Source: NAFEMS 1990, The Standard NAFEMS Benchmarks, TNSB rev. 3, test LE10.
#pragma once

#include "risorius/figures/detail/known_problems.h"

namespace risorius::figures {

/// Returns - sigma_yy over the pressure at the published point: extrapolated from the centres of the cells around it. There are `cells`
/// cells through the thickness, twice as many across the ring and three times as many around it.
double thick_plate(const KnownMaterial& material, int cells);

}  // namespace risorius::figures
