// SPDX-License-Identifier: MIT
#include "risorius/perform/detail/one_euro.h"

#include <cmath>
#include <numbers>

namespace risorius::perform {

namespace {

/// Share of the new value after `dt_s`.
double share_of_new(double cutoff_hz, double dt_s) {
    const double r = 2 * std::numbers::pi * cutoff_hz * dt_s;
    return r / (r + 1);
}

}  // namespace

double OneEuro::operator()(double value, double t_s) {
    if (!any_) {
        any_ = true;
        t_s_ = t_s;
        return value_ = value;
    }
    const double dt_s = t_s - t_s_;
    if (!(dt_s > 0)) return value_;
    t_s_ = t_s;
    const double speed = (value - value_) / dt_s;
    speed_ += share_of_new(options_.speed_cutoff_hz, dt_s) * (speed - speed_);
    const double cutoff_hz = options_.cutoff_hz + options_.per_speed * std::abs(speed_);
    return value_ += share_of_new(cutoff_hz, dt_s) * (value - value_);
}

}  // namespace risorius::perform
