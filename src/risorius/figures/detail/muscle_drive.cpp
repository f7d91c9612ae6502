// SPDX-License-Identifier: MIT
#include "risorius/figures/detail/muscle_drive.h"

#include <algorithm>
#include <cmath>

#include "risorius/muscle/activation.h"

namespace risorius::figures {
namespace {

constexpr double kLatest_s = 1e6;
/// Activation is interpolated linearly between multiples of this time
constexpr double kPiece_s = 0.25e-3;

using Knots = std::vector<std::pair<double, double>>;  ///< time, value

Knots read_knots(const JsonCursor& json, Range range) {
    Knots knots;
    for (const JsonCursor& one : json.items()) {
        const std::vector<JsonCursor> pair = one.items();
        if (pair.size() != 2) one.fail("[time in s, value]");
        const double t_s = pair[0].number({0, kLatest_s});
        if (!knots.empty() && !(t_s > knots.back().first))
            pair[0].fail("more than " + format_number(knots.back().first) + ", the time before it");
        knots.push_back({t_s, pair[1].number(range)});
    }
    if (knots.empty()) json.fail("at least one [time in s, value]");
    return knots;
}

double held(const Knots& knots, double t_s, double before) {
    const auto after = std::upper_bound(knots.begin(), knots.end(), t_s,
                                        [](double t, const auto& knot) { return t < knot.first; });
    return after == knots.begin() ? before : (after - 1)->second;
}

double straight(const Knots& knots, double t_s) {
    const auto after = std::upper_bound(knots.begin(), knots.end(), t_s,
                                        [](double t, const auto& knot) { return t < knot.first; });
    if (after == knots.begin()) return knots.front().second;
    if (after == knots.end()) return knots.back().second;
    const auto& [t0, y0] = *(after - 1);
    const auto& [t1, y1] = *after;
    return y0 + (y1 - y0) * (t_s - t0) / (t1 - t0);
}

Pulses read_pulses(const JsonCursor& json) {
    json.allow_keys({"first_s", "rate_hz", "count", "width_s"});
    Pulses pulses;
    if (const auto v = json.find("first_s")) pulses.first_s = v->number({0, kLatest_s});
    pulses.rate_hz = json.at("rate_hz").number({1e-3, 1e3});
    pulses.count = json.at("count").integer(1, 100000);
    if (const auto v = json.find("width_s")) pulses.width_s = v->number({1e-6, 1 / pulses.rate_hz});
    return pulses;
}

Knots excitation_of(const Pulses& pulses) {
    Knots knots;
    for (int i = 0; i < pulses.count; ++i) {
        knots.push_back({pulses.start_s(i), 1});
        knots.push_back({pulses.start_s(i) + pulses.width_s, 0});
    }
    return knots;
}

/// The activation that follows a piecewise constant excitation.
Knots follow(const Knots& excitation, const muscle::ActivationTimes& times, double until_s) {
    Knots activation{{0, 0}};
    double t_s = 0, a = 0;
    auto next = excitation.begin();
    while (t_s < until_s) {
        while (next != excitation.end() && next->first <= t_s) ++next;
        double to_s = std::min(until_s, t_s + kPiece_s);
        if (next != excitation.end()) to_s = std::min(to_s, next->first);
        a = muscle::advance_activation(a, held(excitation, t_s, 0), times, to_s - t_s);
        t_s = to_s;
        activation.push_back({t_s, a});
    }
    return activation;
}

}  // namespace

Drive read_drive(const JsonCursor& json, double until_s) {
    Drive drive;
    if (const auto direct = json.find("activation")) {
        json.allow_keys({"activation"});
        drive.activation = [knots = read_knots(*direct, {0, 1})](double t_s) {
            return held(knots, t_s, 0);
        };
        return drive;
    }
    json.allow_keys({"activation", "excitation", "pulses", "t_act_s", "t_deact_s"});
    Knots excitation;
    if (const auto pulses = json.find("pulses")) {
        if (json.has("excitation")) json.at("excitation").fail("none beside \"pulses\"");
        drive.pulses = read_pulses(*pulses);
        excitation = excitation_of(*drive.pulses);
    } else {
        excitation = read_knots(json.at("excitation"), {0, 1});
    }
    muscle::ActivationTimes times;
    if (const auto v = json.find("t_act_s")) times.t_act_s = v->number({1e-4, 10});
    if (const auto v = json.find("t_deact_s")) times.t_deact_s = v->number({1e-4, 10});
    drive.activation = [knots = follow(excitation, times, until_s)](double t_s) {
        return straight(knots, t_s);
    };
    return drive;
}

std::function<double(double t_s)> read_course(const JsonCursor& json, Range range) {
    return [knots = read_knots(json, range)](double t_s) { return straight(knots, t_s); };
}

}  // namespace risorius::figures
