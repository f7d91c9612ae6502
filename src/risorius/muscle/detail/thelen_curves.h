// SPDX-License-Identifier: MIT
/// \file
/// The force-length, force-velocity and tendon curves of Thelen's muscle, dimensionless, with the symbols of muscle_curves.h.
///
///   active    e^{-(l - 1)^2 / gamma}
///   passive   (e^{k (l - 1) / e0} - 1) / (e^k - 1) up to l = 1 + e0, where it is 1; beyond that straight, with the same slope
///   velocity  (1 + v) / (1 - v / Af) for v < 0; Flen - (Flen - 1) / (1 + c v), c = (2 + 2 / Af) / (Flen - 1), for v > 0:
///             the published relation solved for f at full activation
///   tendon    like the passive curve up to Ftoe, then straight through (eps0, 1). The toe ends where both slopes agree, at
///             0.60862 eps0 with 1.71189 / eps0, which the paper rounds to 0.609 and 1.712
///
/// The published curves have kinks. Here these are replaced by cubics with the value and slope of the published curves at both
/// ends. The differences from the published curves are
///   passive   l = 1 to 1 + e0 / k: at most 0.0011
///   tendon    eps = 0 to a third of the toe: at most 0.0027
///   velocity  v = 0, where the slope doubles, to 1 / c = 0.04: at most 0.027. Near v = -1, as in detail/hill_branch.h: at
///             most 0.005
///
/// Source: D. G. Thelen 2003, J. Biomech. Eng. 125(1), 70-77; tendon strain and Flen are those of OpenSim's version of it.
#pragma once

#include "risorius/muscle/muscle_curves.h"

namespace risorius::muscle {

/// The numbers of Thelen's curves. The field names are the keys of "curves" in a file.
struct ThelenShape {
    double active_width = 0.45;      ///< gamma, square of a width               (0, inf)
    double passive_strain = 0.6;     ///< e0, strain at which passive f is 1     (0, inf)
    double passive_exponent = 5;     ///< k                                      (1, inf)
    double hill_curvature = 0.25;    ///< Af, a / F0 of Hill's hyperbola         (0, inf)
    double lengthening_force = 1.4;  ///< Flen, limit of f for large v > 0       (1, inf)
    double tendon_strain = 0.04;     ///< eps0, at which fT is 1                 (0, inf)
    double tendon_toe_force = 0.33;  ///< Ftoe                                   (0, 1)
    double tendon_toe_exponent = 3;  ///< k of the tendon                        (1, inf)
};

/// Returns the curves. Throws std::invalid_argument when a number is outside its range.
MuscleCurves thelen_curves(const ThelenShape& shape = {});

}  // namespace risorius::muscle
