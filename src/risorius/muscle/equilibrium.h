// SPDX-License-Identifier: MIT
/// \file
/// Where a musculotendon of given length comes to rest: fibre and tendon in series, in one dimension. What a solid muscle
/// is compared with.
///
///   L    from origin to insertion, m             l   fibre, m; s = sqrt(l^2 - w^2) its length along the tendon, m
///   w    thickness l0 sin alpha, m, constant     cos(alpha) = s / l
///   F0 fT((L - s - lTs) / lTs) = F0 [ a fl(l/l0) + fp(l/l0) ] s / l;   with a rigid tendon s = L - lTs
///
/// Source: F. E. Zajac, Crit. Rev. Biomed. Eng. 17(4), 1989; constant thickness as there.
#pragma once

#include "risorius/muscle/musculotendon.h"

namespace risorius::muscle {

struct Equilibrium {
    double fibre_m = 0;   ///< l
    double tendon_m = 0;  ///< L - s
    double pennation_rad = 0;
    double force_n = 0;  ///< along the tendon
};

/// A muscle shorter than its slack tendon has no force, and its fibre the length at which it has none. Where a falling
/// limb steeper than the tendon allows several equilibria it is one of them.
Equilibrium equilibrium(const MuscleParameters& parameters, const MuscleCurves& curves,
                        double activation, double length_m);

/// What a fibre pulls with at a length and a speed (> 0 lengthens): F0 [ a fl fv + fp + b v/(vmax l0) ], N, along itself.
double fibre_force(const MuscleParameters& parameters, const MuscleCurves& curves,
                   double activation, double fibre_m, double fibre_m_per_s);

}  // namespace risorius::muscle
