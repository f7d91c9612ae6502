// SPDX-License-Identifier: MIT
// Implicit Euler with one linear solve or with Newton's method, and equilibrium.
#include <algorithm>
#include <cmath>

#include "risorius/solve/detail/methods.h"
#include "risorius/solve/detail/stepper.h"
#include "risorius/solve/newton.h"

namespace risorius::solve::detail {

namespace {

/// An equilibrium goes through pseudo-time first, so it gets this many times the iterations of a step of motion.
constexpr int kEquilibriumIterations = 10;

NewtonOptions newton_options(const IntegratorOptions& options) {
    NewtonOptions newton;
    newton.iterations = options.newton_iterations;
    newton.tolerance_m = options.newton_tolerance * options.length_scale_m;
    newton.curvature = options.curvature;
    newton.linear = options.linear;
    newton.first_step_s = options.step_s;
    newton.farthest_m = options.diverged_at * options.length_scale_m;
    return newton;
}

void add(const NewtonReport& newton, IntegratorReport& report) {
    report.evaluations += newton.evaluations;
    report.rejections += newton.halvings;
    report.linear_solves += newton.linear_solves;
    report.diverged = report.diverged || newton.diverged;
}

/// v = (x+ - x) / h
void set_velocity(const Points& start, double h, const Points& x, Points& v) {
    v = (x - start) / h;
}

class ImplicitEuler final : public Stepper {
  public:
    using Stepper::Stepper;

  protected:
    void step(const MotionSystem& system, Points& x, Points& v, double t, double h,
              IntegratorReport& report) override {
        start_ = x;
        target_ = x + h * v;
        const ImplicitStep step{t + h, h, start_};
        system.place_fixed(t + h, x, v);
        // Starts from the inertial position unless its potential is higher than at the start of the step.
        guess_ = target_;
        scratch_ = v;
        system.place_fixed(t + h, guess_, scratch_);
        const double stay = potential(system, step, x, report);
        const double go = potential(system, step, guess_, report);
        if (go <= stay) x.swap(guess_);

        const NewtonReport newton =
            newton_.minimise(system, step, target_, newton_options(options_), x);
        add(newton, report);
        report.converged = report.converged && newton.converged;
        report.error_estimate =
            std::max(report.error_estimate, newton.last_move_m / options_.length_scale_m);
        set_velocity(start_, h, x, v);
    }

  private:
    double potential(const MotionSystem& system, const ImplicitStep& step, const Points& x,
                     IntegratorReport& report) {
        ++report.evaluations;
        double sum = system.potential(step, x, scratch_);
        for (int i = 0; i < system.size(); ++i)
            if (!system.fixed()[static_cast<std::size_t>(i)])
                sum += 0.5 * system.mass_kg()[i] * (x.row(i) - target_.row(i)).squaredNorm() /
                       (step.step_s * step.step_s);
        return sum;
    }

    Newton newton_;
    Points start_, target_, guess_, scratch_;
};

// (M/h^2 + H(x_n)) dx = f(x_n) + M v_n / h: the first Newton move on Phi, from x_n with the fixed nodes at their new places.
class BaraffWitkin final : public Stepper {
  public:
    using Stepper::Stepper;

  protected:
    void step(const MotionSystem& system, Points& x, Points& v, double t, double h,
              IntegratorReport& report) override {
        start_ = x;
        target_ = x + h * v;
        system.place_fixed(t + h, x, v);
        NewtonReport newton;
        if (!newton_.move_once(system, {t + h, h, start_}, target_, options_.linear, x, newton))
            newton.diverged = true;
        add(newton, report);
        set_velocity(start_, h, x, v);
    }

  private:
    Newton newton_;
    Points start_, target_;
};

class QuasiStatic final : public Integrator {
  public:
    explicit QuasiStatic(const IntegratorOptions& options) : options_(options), monitor_(options) {}

    void restart() override { monitor_.restart(); }

    IntegratorReport advance(const MotionSystem& system, MotionState& state,
                             double until_s) override {
        IntegratorReport report;
        if (until_s < state.t_s) return report;
        monitor_.begin(state);
        system.begin_step(state.t_s, std::numeric_limits<double>::infinity(), state.x, state.v);
        system.place_fixed(until_s, state.x, state.v);
        start_ = state.x;
        NewtonOptions options = newton_options(options_);
        options.iterations *= kEquilibriumIterations;
        const NewtonReport newton = newton_.solve_equilibrium(
            system, {until_s, std::numeric_limits<double>::infinity(), start_}, options, state.x);
        add(newton, report);
        report.steps = 1;
        report.converged = newton.converged;
        report.error_estimate = newton.last_move_m / options_.length_scale_m;
        state.v.setZero(system.size(), 3);
        state.t_s = until_s;
        if (report.diverged || monitor_.diverged(state.x, state.v)) {
            report.diverged = true;
            report.diverged_at_s = state.t_s;
        }
        monitor_.end(state);
        return report;
    }

  private:
    const IntegratorOptions options_;
    DivergenceMonitor monitor_;
    Newton newton_;
    Points start_;
};

}  // namespace

std::unique_ptr<Integrator> make_implicit_euler(const IntegratorOptions& options) {
    return std::make_unique<ImplicitEuler>(options);
}
std::unique_ptr<Integrator> make_baraff_witkin(const IntegratorOptions& options) {
    return std::make_unique<BaraffWitkin>(options);
}
std::unique_ptr<Integrator> make_quasi_static(const IntegratorOptions& options) {
    return std::make_unique<QuasiStatic>(options);
}

}  // namespace risorius::solve::detail

namespace risorius::solve {

IntegratorReport equilibrium(const MotionSystem& system, MotionState& state,
                             const IntegratorOptions& options) {
    IntegratorOptions quasi_static = options;
    quasi_static.method = Method::kQuasiStatic;
    return make_integrator(quasi_static)->advance(system, state, state.t_s);
}

}  // namespace risorius::solve
