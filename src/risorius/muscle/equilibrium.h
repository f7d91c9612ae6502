// SPDX-License-Identifier: MIT
/// \file
/// Equilibrium of a musculotendon of given length: a fibre and a tendon in series, in one dimension. Solid muscles are compared
/// with it. Symbols as in musculotendon.h.
///
///   L    from origin to insertion, m             l   fibre, m; s = sqrt(l^2 - w^2) its length along the tendon, m
///   w    thickness l0 sin alpha, m, constant     cos(alpha) = s / l
///   F0 fT((L - s - lTs) / lTs) = F0 [ a fl(l/l0) + fp(l/l0) ] s / l;   with a rigid tendon s = L - lTs
///
/// Source: F. E. Zajac, Crit. Rev. Biomed. Eng. 17(4), 1989, which also keeps the thickness constant.
#pragma once

#include "risorius/muscle/musculotendon.h"

namespace risorius::muscle {

/// The equilibrium of fibre and tendon.
struct Equilibrium {
    double fibre_m = 0;   ///< l
    double tendon_m = 0;  ///< L - s
    double pennation_rad = 0;
    double force_n = 0;  ///< along the tendon
};

/// Computes the equilibrium at the length `length_m` from origin to insertion. A muscle that is shorter than its slack tendon
/// has no force; its fibre then has the length at which its force is zero. Where the force-length curve falls more steeply than
/// the force of the tendon rises, several equilibria exist, and the result is one of them.
Equilibrium equilibrium(const MuscleParameters& parameters, const MuscleCurves& curves,
                        double activation, double length_m);

/// Force of a fibre along its own direction, at a length and a speed (> 0 lengthens): F0 [ a fl fv + fp + b v/(vmax l0) ], N.
double fibre_force(const MuscleParameters& parameters, const MuscleCurves& curves,
                   double activation, double fibre_m, double fibre_m_per_s);

}  // namespace risorius::muscle
