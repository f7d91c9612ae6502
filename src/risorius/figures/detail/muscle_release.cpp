// SPDX-License-Identifier: MIT
#include "risorius/figures/detail/muscle_release.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "risorius/figures/detail/line_muscle.h"
#include "risorius/figures/detail/muscle_runs.h"

namespace risorius::figures {
namespace {

constexpr double kGravity_m_per_s2 = 9.81;
constexpr double kSlowest = 0.01;  ///< lowest expected speed, vmax l0; limits the duration
constexpr double kPatience = 3;    ///< ratio of the largest number of steps to the expected one
/// Step of a load on the tendons, over 1 / its angular frequency
constexpr double kStepOfSwing = 0.2;

/// Normalised length of the musculotendon in equilibrium whose fibres have the given length: the tendon adds its strain.
double length_with_fibres(const softbody::MuscleDescription& muscle, double fibre,
                          double activation) {
    double low = 0.1, high = 3;
    for (int i = 0; i < 60; ++i) {
        const double length = (low + high) / 2;
        (line_fibre_length(muscle, length, activation) < fibre ? low : high) = length;
    }
    return (low + high) / 2;
}

/// Interpolates between the two samples on either side of the length, in both directions of motion.
Passing passing_of(const softbody::MuscleDescription& muscle, MuscleMotion motion, double at) {
    const double max_m_per_s =
        muscle.musculotendon.max_speed_hz * muscle.musculotendon.optimal_length_m;
    Passing passing;
    const std::vector<MuscleSample>& samples = motion.samples;
    for (std::size_t i = 2; i < samples.size() && !passing.found; ++i) {
        const MuscleSample &a = samples[i - 1], &b = samples[i];
        if ((a.stretch - at) * (b.stretch - at) > 0 || a.stretch == b.stretch) continue;
        const double fraction = (at - a.stretch) / (b.stretch - a.stretch);
        passing.force_f0 = a.tension_f0 + fraction * (b.tension_f0 - a.tension_f0);
        passing.speed = a.speed + fraction * (b.speed - a.speed);
        passing.plate_speed = (b.lengthening_m - a.lengthening_m) / ((b.t_s - a.t_s) * max_m_per_s);
        passing.found = true;
    }
    passing.found = passing.found && motion.converged && !motion.diverged;
    passing.motion = std::move(motion);
    return passing;
}

/// True a step or two after the length has been passed.
std::function<bool(const MuscleSample&)> beyond(double at, bool shortens) {
    return [=](const MuscleSample& now) { return shortens ? now.stretch < at : now.stretch > at; };
}

}  // namespace

Passing released_at_speed(const softbody::MuscleDescription& muscle, const ReleaseBench& bench,
                          double speed, const RunOptions& options) {
    const muscle::MuscleParameters& p = muscle.musculotendon;
    const bool shortens = speed < 0;
    const double from = length_with_fibres(
        muscle, bench.at_fibre_length + (shortens ? bench.reach : -bench.reach), bench.activation);
    const double from_m = lengthening_m(muscle, from);
    const double m_per_s = speed * p.max_speed_hz * p.optimal_length_m;
    const double time_s = bench.reach * p.optimal_length_m / std::abs(m_per_s);
    MotionPlan plan{.task = {.activation = [a = bench.activation](double) { return a; },
                             .lengthening_m = [=](double t_s) { return from_m + m_per_s * t_s; }},
                    .load = {},
                    .phases = {{kPatience * time_s, time_s / bench.steps}},
                    .ended = beyond(bench.at_fibre_length, shortens)};
    return passing_of(muscle, move_muscle(muscle, plan, options), bench.at_fibre_length);
}

Passing released_with_load(const softbody::MuscleDescription& muscle, const ReleaseBench& bench,
                           double load_f0, const RunOptions& options) {
    const muscle::MuscleParameters& p = muscle.musculotendon;
    const double expected =
        std::abs(line_speed(muscle, load_f0, bench.at_fibre_length, bench.activation));
    const double time_s =
        bench.reach / (std::max(kSlowest, std::min(expected, 1.0)) * p.max_speed_hz);
    const double force_n = load_f0 * p.f0_n, mass_kg = force_n / kGravity_m_per_s2;
    const double stiffness = line_tendon_stiffness(muscle);
    const double step_s =
        std::min(time_s / bench.steps, kStepOfSwing * std::sqrt(mass_kg / stiffness));
    const double from_m = lengthening_m(
        muscle, length_with_fibres(muscle, bench.at_fibre_length + bench.reach, bench.activation));
    MotionPlan plan{.task = {.activation = [a = bench.activation](double) { return a; },
                             .lengthening_m = [=](double) { return from_m; }},
                    .load = Load{.force_n = force_n, .mass_kg = mass_kg, .from_s = 0},
                    .phases = {{kPatience * time_s, step_s}},
                    .ended = beyond(bench.at_fibre_length, /*shortens=*/true)};
    return passing_of(muscle, move_muscle(muscle, plan, options), bench.at_fibre_length);
}

Hill hill_through(const std::vector<double>& force_f0, const std::vector<double>& speed) {
    // (1 - P) / v = (P + a) / b is linear in P
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (std::size_t i = 0; i < speed.size(); ++i) {
        const double x = force_f0[i], y = (1 - x) / speed[i];
        n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
    const double first = (sy - slope * sx) / n;
    return {.a_f0 = first / slope, .max_speed = 1 / first};
}

}  // namespace risorius::figures
