// SPDX-License-Identifier: MIT
#include "risorius/figures/detail/line_muscle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "risorius/figures/detail/muscle_runs.h"
#include "risorius/muscle/equilibrium.h"

namespace risorius::figures {
namespace {

constexpr int kHalvings = 60;

muscle::Equilibrium equilibrium_at(const softbody::MuscleDescription& muscle, double length,
                                   double activation) {
    const muscle::MuscleParameters& p = muscle.musculotendon;
    return muscle::equilibrium(p, muscle::make_curves(p.curves), activation,
                               length * p.optimal_length_m + p.tendon_slack_m);
}

/// Cosine of the angle between the fibres and the tendon.
double cos_pennation(const softbody::MuscleDescription& muscle, double fibre_length) {
    const double w = std::sin(muscle.musculotendon.pennation_deg * std::numbers::pi / 180);
    return std::cos(std::asin(std::min(1.0, w / fibre_length)));
}

}  // namespace

double line_tension(const softbody::MuscleDescription& muscle, double length, double activation) {
    return equilibrium_at(muscle, length, activation).force_n / muscle.musculotendon.f0_n;
}

double line_tension_in_matrix(const softbody::MuscleDescription& muscle, double volume_m3,
                              double length, double activation) {
    const muscle::MuscleParameters& p = muscle.musculotendon;
    const muscle::MuscleCurves curves = muscle::make_curves(p.curves);
    const double belly = normalised_length(muscle, 0);
    const double thickness = std::sin(p.pennation_deg * std::numbers::pi / 180);
    const double stiffness =
        muscle.moduli.mu_pa * volume_m3 / (belly * p.optimal_length_m * p.f0_n);
    // `span`: length of the belly over l0
    const auto pull = [&](double span) {
        const double l = std::hypot(span, thickness), s = span / belly;
        return (activation * curves.active.value(l) + curves.passive.value(l)) * span / l +
               stiffness * (s * (s * s - 1) - (1 / s - 1) / (s * s));
    };
    const auto tendon = [&](double span) {
        return curves.tendon.value((length - span) * p.optimal_length_m / p.tendon_slack_m);
    };
    if (!(pull(length) > 0)) return 0;  // tendons do not push
    double low = 0, high = length;
    for (int i = 0; i < kHalvings; ++i) {
        const double span = (low + high) / 2;
        (pull(span) > tendon(span) ? high : low) = span;
    }
    return tendon(high);
}

double line_fibre_length(const softbody::MuscleDescription& muscle, double length,
                         double activation) {
    return equilibrium_at(muscle, length, activation).fibre_m /
           muscle.musculotendon.optimal_length_m;
}

double line_tendon_stiffness(const softbody::MuscleDescription& muscle) {
    constexpr double kBeyondToe = 1;
    const muscle::MuscleParameters& p = muscle.musculotendon;
    return p.f0_n * muscle::make_curves(p.curves).tendon.at(kBeyondToe).slope / p.tendon_slack_m;
}

double line_moving_tension(const softbody::MuscleDescription& muscle, double fibre_length,
                           double speed, double activation) {
    const muscle::MuscleParameters& p = muscle.musculotendon;
    const double force_n = muscle::fibre_force(p, muscle::make_curves(p.curves), activation,
                                               fibre_length * p.optimal_length_m,
                                               speed * p.max_speed_hz * p.optimal_length_m);
    return cos_pennation(muscle, fibre_length) * force_n / p.f0_n;
}

double line_speed(const softbody::MuscleDescription& muscle, double tension_f0, double fibre_length,
                  double activation) {
    double low = -2, high = 2;
    for (int i = 0; i < kHalvings; ++i) {
        const double v = (low + high) / 2;
        (line_moving_tension(muscle, fibre_length, v, activation) < tension_f0 ? low : high) = v;
    }
    return (low + high) / 2;
}

double line_load_speed(const softbody::MuscleDescription& muscle, double tension_f0,
                       double fibre_length, double activation) {
    return line_speed(muscle, tension_f0, fibre_length, activation) /
           cos_pennation(muscle, fibre_length);
}

}  // namespace risorius::figures
