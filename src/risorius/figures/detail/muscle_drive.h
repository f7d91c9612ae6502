// SPDX-License-Identifier: MIT
/// \file
/// The input of a muscle over time: its length, and its activation, which is given directly or follows an excitation.
///
///   "drive": {"activation": [[0, 0], [0.001, 1]]}                      piecewise constant: [time, value], ...
///            {"excitation": [[0, 0], [0.01, 1]], "t_act_s": 0.010, "t_deact_s": 0.040}
///            {"pulses": {"first_s": 0.01, "rate_hz": 20, "count": 8, "width_s": 0.005}, "t_act_s": ..}     pulses of excitation 1
///   "length": [[0, 1], [0.2, 1], [0.201, 0.9375]]                      normalised (muscle_runs.h), piecewise linear
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/muscle/musculotendon.h"

namespace risorius::figures {

struct Pulses {
    double first_s = 0, rate_hz = 1, width_s = 0.005;
    int count = 1;

    double start_s(int pulse) const { return first_s + pulse / rate_hz; }
};

struct Drive {
    muscle::ActivationAt activation;
    std::optional<Pulses> pulses;
};

/// Reads a drive. An activation that follows an excitation is computed up to the time `until_s`.
Drive read_drive(const JsonCursor& json, double until_s);

/// Reads a piecewise linear function of time. It is constant before its first and after its last knot. Throws Error for values
/// outside `range`.
std::function<double(double t_s)> read_course(const JsonCursor& json, Range range);

}  // namespace risorius::figures
