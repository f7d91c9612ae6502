#include "solve/real_time_step.h"

#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <utility>

namespace risorius::solve {

RealTimeStep::RealTimeStep(const MotionSystem& system,
                           std::shared_ptr<Preconditioner> preconditioner,
                           const RealTimeOptions& options)
    : system_(system), preconditioner_(std::move(preconditioner)), options_(options) {
    if (!(options_.step_s > 0 && std::isfinite(options_.step_s)) || options_.iterations < 1 ||
        options_.memory < 0 || !(options_.accuracy >= 0) || !(options_.length_scale_m > 0))
        throw std::invalid_argument("RealTimeStep: an option is outside its range");
}

StepReport RealTimeStep::advance(MotionState& state) {
    const double h = options_.step_s, rate_hz = 1.0 / h;
    const int n = system_.size();
    start_ = state.x;
    inertial_ = state.x + h * state.v;
    x_ = inertial_;
    static const int mode = getenv("PRED") ? atoi(getenv("PRED")) : 1;
    const bool known = left_.size() == state.x.size() && left_ == state.x;
    if (!known) history_ = 0;
    if (mode >= 1 && history_ == 1) x_ += h * h * acceleration_;
    if (mode >= 2 && history_ >= 2) x_ += h * h * (2 * acceleration_ - before_);
    else if (mode == 1 && history_ >= 2) x_ += h * h * acceleration_;
    const Points v_before = state.v;
    // Fixed nodes go where they are led
    Points& v = state.v;
    system_.place_fixed(state.t_s + h, x_, v);
    for (int i = 0; i < n; ++i)
        if (system_.fixed()[static_cast<std::size_t>(i)]) inertial_.row(i) = x_.row(i);
    system_.begin_step(state.t_s, h, start_, v);

    const ImplicitStep step{state.t_s + h, h, start_};
    const auto potential = [&](const Points& x, Points& gradient) {
        double sum = system_.potential(step, x, gradient);
        double inertia = 0;
        const double* const at = x.data();
        const double* const free = inertial_.data();
        double* const g = gradient.data();
        for (int i = 0; i < n; ++i) {
            if (system_.fixed()[static_cast<std::size_t>(i)]) continue;
            const double k = system_.mass_kg()[i] * rate_hz * rate_hz;
            for (int c = 3 * i; c < 3 * i + 3; ++c) {
                const double d = at[c] - free[c];
                inertia += k * d * d;
                g[c] += k * d;
            }
        }
        return sum + 0.5 * inertia;
    };
    preconditioner_->refresh(step, x_);
    QuasiNewtonOptions options;
    options.iterations = options_.iterations;
    options.memory = options_.memory;
    options.step_cap_m = options_.length_scale_m;
    options.tolerance_rms_m =
        options_.accuracy * std::sqrt((x_ - start_).squaredNorm() / std::max(n, 1));
    const StepReport report = solver_.minimise(
        potential, [&](const Points& b, Points& x) { preconditioner_->apply(b, x); }, x_, options);

    for (int i = 0; i < n; ++i)
        if (!system_.fixed()[static_cast<std::size_t>(i)])
            state.v.row(i) = (x_.row(i) - start_.row(i)) * rate_hz;
    state.x.swap(x_);
    left_ = state.x;
    before_ = acceleration_;
    acceleration_ = (state.v - v_before) * rate_hz;
    ++history_;
    state.t_s += h;
    return report;
}

}  // namespace risorius::solve
