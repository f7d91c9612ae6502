// SPDX-License-Identifier: MIT
// The loops over fixed and over controlled steps.
#include "risorius/solve/detail/stepper.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "risorius/solve/point_sums.h"

namespace risorius::solve::detail {

namespace {

constexpr double kBulirschStoerTolerance = 1e-6;  ///< when the options give none

/// Tolerance for having reached `until`: rounding of k h, or of the caller's own sum of steps.
double closeness(double h, double until_s) {
    return std::max(1e-9 * h, 4 * std::numeric_limits<double>::epsilon() * std::abs(until_s));
}

}  // namespace

DivergenceMonitor::DivergenceMonitor(const IntegratorOptions& options)
    : farthest_squared_(std::pow(options.diverged_at * options.length_scale_m, 2)),
      left_at_s_(std::numeric_limits<double>::quiet_NaN()) {}

bool DivergenceMonitor::begin(const MotionState& state) {
    if (state.t_s == left_at_s_ && state.x.rows() == began_.rows()) return false;
    began_ = state.x;
    return true;
}

bool DivergenceMonitor::diverged(const Points& x, const Points& v) const {
    const double* p = x.data();
    const double* p0 = began_.data();
    const double* q = v.data();
    // If the squared motion of all nodes together is below the limit, so is that of each. NaN goes on to the second check.
    const long n = x.size();
    Lanes moved{}, speed{};
    long k = 0;
    for (; k + 3 < n; k += 4) {
        const Lanes d = load_lanes(p + k) - load_lanes(p0 + k), u = load_lanes(q + k);
        moved += d * d;
        speed += u * u;
    }
    double moved_sum = sum_lanes(moved), speed_sum = sum_lanes(speed);
    for (; k < n; ++k) {
        moved_sum += (p[k] - p0[k]) * (p[k] - p0[k]);
        speed_sum += q[k] * q[k];
    }
    if (moved_sum <= farthest_squared_ && speed_sum <= std::numeric_limits<double>::max())
        return false;

    bool bad = false;
    for (long i = 0; i < x.rows(); ++i, p += 3, p0 += 3, q += 3) {
        const double dx = p[0] - p0[0], dy = p[1] - p0[1], dz = p[2] - p0[2];
        const double speed_squared = q[0] * q[0] + q[1] * q[1] + q[2] * q[2];
        // Written so that NaN counts as diverged.
        bad |= !(dx * dx + dy * dy + dz * dz <= farthest_squared_);
        bad |= !(speed_squared <= std::numeric_limits<double>::max());
    }
    return bad;
}

Stepper::Stepper(const IntegratorOptions& options) : options_(options), monitor_(options) {}

void Stepper::restart() {
    monitor_.restart();
    forget();
}

IntegratorReport Stepper::advance(const MotionSystem& system, MotionState& state, double until_s) {
    assert(state.x.rows() == system.size() && state.v.rows() == system.size());
    IntegratorReport report;
    const auto diverge = [&] {
        report.diverged = true;
        report.diverged_at_s = state.t_s;
    };
    if (monitor_.begin(state)) {
        forget();
        origin_s_ = state.t_s;
        count_ = 0;
        system.place_fixed(state.t_s, state.x, state.v);
    }
    if (monitor_.diverged(state.x, state.v)) {
        diverge();
        return report;
    }

    const double h = options_.step_s;
    const double close = closeness(h, until_s);
    for (;;) {
        const double t = origin_s_ + static_cast<double>(count_) * h;
        if (until_s - t <= close) break;
        double end = origin_s_ + static_cast<double>(count_ + 1) * h;
        const bool whole = end <= until_s + close;
        if (!whole) end = until_s;
        const double dt = whole ? h : until_s - t;

        system.begin_step(t, dt, state.x, state.v);
        step(system, state.x, state.v, t, dt, report);
        system.place_fixed(end, state.x, state.v);
        ++report.steps;
        if (whole) {
            ++count_;
        } else {
            origin_s_ = end;
            count_ = 0;
        }
        state.t_s = std::abs(end - until_s) <= close ? until_s : end;
        if (report.diverged || monitor_.diverged(state.x, state.v)) {
            diverge();
            break;
        }
    }
    monitor_.end(state);
    return report;
}

ControlledStepper::ControlledStepper(const IntegratorOptions& options)
    : options_(options),
      tolerance_(options.tolerance > 0 ? options.tolerance : kBulirschStoerTolerance),
      monitor_(options),
      step_s_(options.step_s) {}

void ControlledStepper::restart() {
    monitor_.restart();
    step_s_ = options_.step_s;
    forget();
}

double ControlledStepper::scaled_error(const Points& dx, const Points& dv, double h) const {
    const double* p = dx.data();
    const double* q = dv.data();
    double max_x = 0, max_v = 0, poison = 0;
    for (long i = 0; i < dx.size(); ++i) {
        max_x = std::max(max_x, std::abs(p[i]));
        max_v = std::max(max_v, std::abs(q[i]));
        poison += 0.0 * p[i] + 0.0 * q[i];  // std::max drops NaN; this keeps it
    }
    return std::max(max_x, h * max_v) / (tolerance_ * options_.length_scale_m) + poison;
}

IntegratorReport ControlledStepper::advance(const MotionSystem& system, MotionState& state,
                                            double until_s) {
    assert(state.x.rows() == system.size() && state.v.rows() == system.size());
    IntegratorReport report;
    const auto diverge = [&] {
        report.diverged = true;
        report.diverged_at_s = state.t_s;
    };
    if (monitor_.begin(state)) {
        forget();
        step_s_ = options_.step_s;
        system.place_fixed(state.t_s, state.x, state.v);
    }
    if (monitor_.diverged(state.x, state.v)) {
        diverge();
        return report;
    }

    while (!report.diverged && until_s - state.t_s > closeness(step_s_, until_s)) {
        const double t = state.t_s;
        const double left = until_s - t;
        // Two equal last steps instead of a full one and a tiny one.
        double h = left <= step_s_ ? left : left < 2 * step_s_ ? left / 2 : step_s_;
        system.begin_step(t, h, state.x, state.v);
        for (bool first = true;; first = false) {
            const bool shortened = h < step_s_;
            const Attempt result = attempt(system, state.x, state.v, t, h, first, report);
            if (result.error <= 1) {
                // A step that was cut short by the end of the interval is no reason for shorter steps.
                step_s_ = shortened && first ? std::max(step_s_, result.next_s) : result.next_s;
                report.error_estimate = std::max(report.error_estimate, result.error * tolerance_);
                const double end = t + h;
                state.t_s = std::abs(end - until_s) <= closeness(h, until_s) ? until_s : end;
                state.x.swap(trial_x_);
                state.v.swap(trial_v_);
                system.place_fixed(state.t_s, state.x, state.v);
                ++report.steps;
                if (monitor_.diverged(state.x, state.v)) diverge();
                break;
            }
            ++report.rejections;
            h = std::min(result.next_s, 0.9 * h);
            step_s_ = h;
            if (h < options_.min_step_s) {
                diverge();
                break;
            }
        }
    }
    monitor_.end(state);
    return report;
}

}  // namespace risorius::solve::detail
