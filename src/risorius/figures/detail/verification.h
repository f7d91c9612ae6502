// SPDX-License-Identifier: MIT
/// \file
/// Kind "verification": solids of trilinear cells (tissue/cell_solid.h) against problems whose solution is known.
///
///   "problem": "cantilever", "young_pa": 1000, "poisson_ratios": [0, 0.3, 0.49, 0.499], "cells": [1, 2, 4, 8]
///
/// cells   number of cells across the body (cantilever, torsion), through it (thick-plate) or along each edge (cook, patch, manufactured)
/// nu      each of the Poisson's ratios; K is Lame's first parameter, mu the shear modulus
///
/// problem       solution                                                                    measures
/// cantilever    w = P L^3 / (3 E I) + P L / (k G A), L = 10 edges of a square section,      deflection_ratio/<nu>/<cells>: w / that
///               k = 10 (1 + nu) / (12 + 11 nu) (Timoshenko, with k of Cowper 1966)
/// cook          the panel of Cook 1974: (0, 0) (48, 44) (48, 60) (0, 44), thickness 1,       tip/<nu>/<cells>: w E / F in the middle
///               plane stress, clamped at the left, F upwards at the right                   of the right edge
/// patch         x = F X, F constant, on a distorted mesh                                     error/<nu>/<cells>: farthest node / edge
/// torsion       T = mu pi R^4 / 2 theta / L, a round bar, L = 10 R                           torque_ratio/<nu>/<cells>: T / that
/// thick-plate   a quarter of an elliptic ring under pressure (LE10 of NAFEMS 1990),        stress/<nu>/<cells>: - sigma_yy over the
///               sigma_yy = -5.38 of the pressure                                            pressure at the inner edge of the face
/// manufactured  x = X + u, u smooth and given, with the body force - Div P that it needs     error/<nu>/<cells>: RMS / RMS of u
///
/// A clamp also keeps the section of the cantilever from changing, which Timoshenko's beam leaves out. "solutions" are the deflections with
/// it over Timoshenko's, one for each nu (a second program finds them: tests/second/clamped_bar.py); deflection_ratio is then w over them.
/// "lengthwise" is the number of cells along the cantilever for each cell across; 1: cubes.
///
/// For each two neighbours in "cells", order/<nu>/<cells> is the power of the spacing with which the distance from the solution falls.
/// Loads are so small that the response is linear, but for patch and manufactured, which have finite strains.
#pragma once

#include "risorius/figures/detail/experiment_kind.h"

namespace risorius::figures {

void run_verification(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome);

}  // namespace risorius::figures
