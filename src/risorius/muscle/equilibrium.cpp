// SPDX-License-Identifier: MIT
#include "risorius/muscle/equilibrium.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace risorius::muscle {

Equilibrium equilibrium(const MuscleParameters& p, const MuscleCurves& curves, double activation,
                        double length_m) {
    const double thickness =
        p.optimal_length_m * std::sin(p.pennation_deg * std::numbers::pi / 180);
    // Force of the fibre along the tendon, as a fraction of F0.
    const auto pull = [&](double span) {
        const double fibre = std::hypot(span, thickness);
        if (!(fibre > 0)) return 0.0;
        const double l = fibre / p.optimal_length_m;
        return (activation * curves.active.value(l) + curves.passive.value(l)) * span / fibre;
    };
    const auto excess = [&](double span) {
        const double strain = (length_m - span) / p.tendon_slack_m - 1;
        return pull(span) - curves.tendon.value(strain);
    };

    // With a slack tendon the fibre has its maximum length. A fibre with force is shorter and has stretched the tendon.
    double span = std::max(0.0, length_m - p.tendon_slack_m);
    if (p.tendon == TendonModel::kElastic && p.tendon_slack_m > 0 && excess(span) > 0) {
        double shortest = 0, longest = span;
        for (int i = 0; i < 200 && longest - shortest > 1e-16 * p.optimal_length_m; ++i) {
            span = 0.5 * (shortest + longest);
            (excess(span) > 0 ? longest : shortest) = span;
        }
    }
    const double fibre = std::hypot(span, thickness);
    return {.fibre_m = fibre,
            .tendon_m = length_m - span,
            .pennation_rad = std::atan2(thickness, span),
            .force_n = p.f0_n * pull(span)};
}

double fibre_force(const MuscleParameters& p, const MuscleCurves& curves, double activation,
                   double fibre_m, double fibre_m_per_s) {
    const double l = fibre_m / p.optimal_length_m;
    const double v = fibre_m_per_s / (p.max_speed_hz * p.optimal_length_m);
    return p.f0_n * (activation * curves.active.value(l) * curves.velocity.value(v) +
                     curves.passive.value(l) + p.damping * v);
}

}  // namespace risorius::muscle
