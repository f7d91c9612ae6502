// SPDX-License-Identifier: MIT
#include "risorius/solve/real_time_step.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "risorius/solve/point_sums.h"

namespace risorius::solve {

RealTimeStep::RealTimeStep(const MotionSystem& system,
                           std::shared_ptr<Preconditioner> preconditioner,
                           const RealTimeOptions& options)
    : system_(system), preconditioner_(std::move(preconditioner)), options_(options) {
    if (!(options_.step_s > 0 && std::isfinite(options_.step_s)) || options_.iterations < 1 ||
        options_.memory < 0 || !(options_.accuracy >= 0) || !(options_.length_scale_m > 0))
        throw std::invalid_argument("RealTimeStep: an option is outside its range");
}

double RealTimeStep::potential(const ImplicitStep& step, const Points& x, Points& gradient) const {
    const double sum = system_.potential(step, x, gradient);
    const double rate_hz = step.rate_hz();
    double inertia = 0;
    const double *const at = x.data(), *const target = inertial_.data();
    double* const g = gradient.data();
    for (int i = 0; i < system_.size(); ++i) {
        if (system_.fixed()[static_cast<std::size_t>(i)]) continue;
        const double k = system_.mass_kg()[i] * rate_hz * rate_hz;
        for (int c = 3 * i; c < 3 * i + 3; ++c) {
            const double d = at[c] - target[c];
            inertia += k * d * d;
            g[c] += k * d;
        }
    }
    return sum + 0.5 * inertia;
}

StepReport RealTimeStep::minimise(const ImplicitStep& step, Points& x) {
    preconditioner_->refresh(step, x);
    const double nodes = std::max(system_.size(), 1);
    QuasiNewtonOptions options;
    options.iterations = options_.iterations;
    options.memory = options_.memory;
    options.step_cap_m = options_.length_scale_m;
    options.tolerance_rms_m = options_.accuracy * std::sqrt((x - start_).squaredNorm() / nodes);
    return solver_.minimise(
        [&](const Points& at, Points& gradient) { return potential(step, at, gradient); },
        [&](const Points& b, Points& y) { preconditioner_->apply(b, y); }, x, options);
}

StepReport RealTimeStep::advance(MotionState& state) {
    const double h = options_.step_s, rate_hz = 1.0 / h;
    const int n = system_.size();
    start_ = state.x;
    inertial_ = state.x + h * state.v;
    const bool follows = left_x_.rows() == n && left_x_ == state.x && left_v_ == state.v;
    x_ = inertial_;
    if (follows) x_ += (h * h) * acceleration_;
    acceleration_ = -rate_hz * state.v;

    // Fixed nodes go to their prescribed places.
    Points& v = state.v;
    system_.place_fixed(state.t_s + h, x_, v);
    for (int i = 0; i < n; ++i)
        if (system_.fixed()[static_cast<std::size_t>(i)]) inertial_.row(i) = x_.row(i);
    system_.begin_step(state.t_s, h, start_, v);

    const ImplicitStep step{state.t_s + h, h, start_};
    StepReport report = minimise(step, x_);

    // Phi only falls from where the search began. If that start was too high, the search is repeated from the start of the
    // step.
    left_x_ = start_;
    for (int i = 0; i < n; ++i)
        if (system_.fixed()[static_cast<std::size_t>(i)]) left_x_.row(i) = x_.row(i);
    const double at_rest = potential(step, left_x_, left_v_);
    ++report.evaluations;
    // Written so that NaN is rejected.
    if (!(report.energy_j <= at_rest)) {
        x_ = left_x_;
        const StepReport first = report;
        report = minimise(step, x_);
        report.iterations += first.iterations;
        report.evaluations += first.evaluations;
        report.backtracks += first.backtracks;
    }

    for (int i = 0; i < n; ++i)
        if (!system_.fixed()[static_cast<std::size_t>(i)])
            state.v.row(i) = (x_.row(i) - start_.row(i)) * rate_hz;
    acceleration_ += rate_hz * state.v;
    state.x.swap(x_);
    state.t_s += h;
    left_x_ = state.x;
    left_v_ = state.v;
    return report;
}

}  // namespace risorius::solve
