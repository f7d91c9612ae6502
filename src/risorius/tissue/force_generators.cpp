// SPDX-License-Identifier: MIT
#include "risorius/tissue/force_generators.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "risorius/core/json_cursor.h"

namespace risorius::tissue {

namespace {

/// Integral of the force over the first `s` seconds of the pulse, N s; s in [0, duration].
double impulse_since_start(const Pulse& pulse, double s) {
    switch (pulse.shape) {
        case PulseShape::kBox:
            return pulse.amplitude_n * s;
        case PulseShape::kTriangle: {
            const double T = pulse.duration_s, left = T - s;
            return pulse.amplitude_n * (s < 0.5 * T ? s * s / T : 0.5 * T - left * left / T);
        }
        case PulseShape::kSine: {
            const double w = 2 * std::numbers::pi * pulse.frequency_hz;
            return pulse.amplitude_n / w *
                   (std::cos(pulse.phase_rad) - std::cos(w * s + pulse.phase_rad));
        }
    }
    return 0;
}

}  // namespace

const std::vector<std::string_view>& pulse_shape_names() {
    static const std::vector<std::string_view> names = {"box", "triangle", "sine"};
    return names;
}

PulseShape pulse_shape_named(std::string_view name) {
    const auto& names = pulse_shape_names();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
        throw std::invalid_argument("no pulse is called " + std::string(name));
    return static_cast<PulseShape>(found - names.begin());
}

double force_n(const Pulse& pulse, double t_s) {
    const double s = t_s - pulse.start_s;
    if (!(s >= 0 && s < pulse.duration_s)) return 0;
    switch (pulse.shape) {
        case PulseShape::kBox:
            return pulse.amplitude_n;
        case PulseShape::kTriangle:
            return pulse.amplitude_n * (1 - std::abs(2 * s / pulse.duration_s - 1));
        case PulseShape::kSine:
            return pulse.amplitude_n *
                   std::sin(2 * std::numbers::pi * pulse.frequency_hz * s + pulse.phase_rad);
    }
    return 0;
}

double impulse_ns(const Pulse& pulse, double from_s, double to_s) {
    const double from = std::clamp(from_s - pulse.start_s, 0.0, pulse.duration_s);
    const double to = std::clamp(to_s - pulse.start_s, 0.0, pulse.duration_s);
    if (from == to) return 0;
    return impulse_since_start(pulse, to) - impulse_since_start(pulse, from);
}

void check(const ForceGenerator& generator, const std::string& place) {
    const Pulse& pulse = generator.pulse;
    const auto expect = [&](bool holds, const char* field, const char* expected, double found) {
        if (!holds) throw Error(place + "/" + field, expected, format_number(found));
    };
    expect(std::isfinite(pulse.amplitude_n), "amplitude_n", "a finite number", pulse.amplitude_n);
    expect(std::isfinite(pulse.start_s), "start_s", "a finite number", pulse.start_s);
    const bool ends = pulse.shape == PulseShape::kTriangle;
    expect(pulse.duration_s > 0 && (!ends || std::isfinite(pulse.duration_s)), "duration_s",
           ends ? "(0, inf) for a triangle" : "(0, inf]", pulse.duration_s);
    if (pulse.shape == PulseShape::kSine) {
        expect(pulse.frequency_hz > 0 && std::isfinite(pulse.frequency_hz), "frequency_hz",
               "(0, inf)", pulse.frequency_hz);
        expect(std::isfinite(pulse.phase_rad), "phase_rad", "a finite number", pulse.phase_rad);
    }
    const double length = generator.direction.norm();
    expect(length > 0 && std::isfinite(length), "direction", "a vector of length > 0", length);
    if (generator.at.count() == 0) throw Error(place + "/at", "a point of the body", "no nodes");
}

ForceGenerators::ForceGenerators(std::vector<ForceGenerator> generators)
    : generators_(std::move(generators)) {
    for (ForceGenerator& generator : generators_) generator.direction.normalize();
}

void ForceGenerators::add_force(double t_s, const Points&, const Points&, Points& force) const {
    for (const ForceGenerator& generator : generators_)
        generator.at.scatter(Vec3(force_n(generator.pulse, t_s) * generator.direction), force);
}

double ForceGenerators::energy(double t_s, const Points& x) const {
    double energy = 0;
    for (const ForceGenerator& generator : generators_)
        energy -= force_n(generator.pulse, t_s) * generator.direction.dot(generator.at.of(x));
    return energy;
}

double ForceGenerators::add_potential(const solve::ImplicitStep& step, const Points& x,
                                      Points& gradient) const {
    double sum = 0;
    for (const ForceGenerator& generator : generators_) {
        const double force =
            std::isfinite(step.step_s)
                ? impulse_ns(generator.pulse, step.end_s - step.step_s, step.end_s) / step.step_s
                : force_n(generator.pulse, step.end_s);
        if (force == 0) continue;
        const Vec3 slope = -force * generator.direction;
        sum += slope.dot(generator.at.of(x));
        generator.at.scatter(slope, gradient);
    }
    return sum;
}

}  // namespace risorius::tissue
