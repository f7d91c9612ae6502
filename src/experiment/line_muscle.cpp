#include "experiment/line_muscle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace risorius::experiment {
namespace {

constexpr int kHalvings = 60;

double thickness(const body::MuscleDescription& muscle) {  // w / l0
    return std::sin(muscle.musculotendon.pennation_deg * std::numbers::pi / 180);
}

/// s / l of a fibre.
double along(const body::MuscleDescription& muscle, double fibre_length) {
    const double w = thickness(muscle);
    return std::sqrt(std::max(0.0, 1 - w * w / (fibre_length * fibre_length)));
}

/// eps in equilibrium.
double tendon_strain(const body::MuscleDescription& muscle, double length, double activation) {
    const muscle::MuscleCurves curves = muscle::zajac_curves();
    const double slack =
        muscle.musculotendon.tendon_slack_m / muscle.musculotendon.optimal_length_m;
    const double w = thickness(muscle);
    double low = 0, high = length / slack;
    for (int i = 0; i < kHalvings; ++i) {
        const double eps = (low + high) / 2, s = length - eps * slack, l = std::hypot(s, w);
        const double pull = (activation * curves.active.value(l) + curves.passive.value(l)) * s / l;
        (curves.tendon.value(eps) < pull ? low : high) = eps;
    }
    return low;
}

}  // namespace

double line_tension(const body::MuscleDescription& muscle, double length, double activation) {
    return muscle::zajac_curves().tendon.value(tendon_strain(muscle, length, activation));
}

double line_fibre_length(const body::MuscleDescription& muscle, double length, double activation) {
    const double slack =
        muscle.musculotendon.tendon_slack_m / muscle.musculotendon.optimal_length_m;
    return std::hypot(length - tendon_strain(muscle, length, activation) * slack,
                      thickness(muscle));
}

double line_tendon_stiffness(const body::MuscleDescription& muscle) {
    constexpr double kBeyondToe = 1;
    return muscle.musculotendon.f0_n * muscle::zajac_curves().tendon.at(kBeyondToe).slope /
           muscle.musculotendon.tendon_slack_m;
}

double line_moving_tension(const body::MuscleDescription& muscle, double fibre_length, double speed,
                           double activation) {
    const muscle::MuscleCurves curves = muscle::zajac_curves();
    return along(muscle, fibre_length) *
           (activation * curves.active.value(fibre_length) * curves.velocity.value(speed) +
            curves.passive.value(fibre_length) + muscle.musculotendon.damping * speed);
}

double line_speed(const body::MuscleDescription& muscle, double tension_f0, double fibre_length,
                  double activation) {
    double low = -2, high = 2;
    for (int i = 0; i < kHalvings; ++i) {
        const double v = (low + high) / 2;
        (line_moving_tension(muscle, fibre_length, v, activation) < tension_f0 ? low : high) = v;
    }
    return (low + high) / 2;
}

double line_load_speed(const body::MuscleDescription& muscle, double tension_f0,
                       double fibre_length, double activation) {
    return line_speed(muscle, tension_f0, fibre_length, activation) / along(muscle, fibre_length);
}

}  // namespace risorius::experiment
