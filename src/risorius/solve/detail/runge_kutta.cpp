// SPDX-License-Identifier: MIT
// One-step explicit methods with fixed steps: Euler, Verlet, Runge-Kutta 2 and 4. Source: Press et al., Numerical Recipes, ch.
// 17.
#include "risorius/solve/detail/runge_kutta.h"

#include "risorius/solve/detail/methods.h"
#include "risorius/solve/detail/stepper.h"

namespace risorius::solve::detail {

void RungeKutta4Step::apply(const MotionSystem& system, double t_s, double h, const Points& a,
                            Points& x, Points& v) {
    const double half = 0.5 * h;
    stage_ = x + half * v;
    v2_ = v + half * a;
    system.place_fixed(t_s + half, stage_, v2_);
    system.acceleration(t_s + half, stage_, v2_, a2_);

    stage_ = x + half * v2_;
    v3_ = v + half * a2_;
    system.place_fixed(t_s + half, stage_, v3_);
    system.acceleration(t_s + half, stage_, v3_, a3_);

    stage_ = x + h * v3_;
    v4_ = v + h * a3_;
    system.place_fixed(t_s + h, stage_, v4_);
    system.acceleration(t_s + h, stage_, v4_, a4_);

    x += (h / 6) * (v + 2 * v2_ + 2 * v3_ + v4_);
    v += (h / 6) * (a + 2 * a2_ + 2 * a3_ + a4_);
}

namespace {

class Euler final : public Stepper {
  public:
    using Stepper::Stepper;

  protected:
    void step(const MotionSystem& system, Points& x, Points& v, double t, double h,
              IntegratorReport& report) override {
        system.acceleration(t, x, v, a_);
        ++report.evaluations;
        x += h * v;
        v += h * a_;
    }

  private:
    Points a_;
};

// r+ = 2 r - r- + h^2 a(r, (r - r-)/h). The state keeps v = (r - r-)/h, the velocity half a step ago. At the start there is no
// earlier step and v belongs to the start time: r+ = r + h v + h^2 a / 2. When the step size changes, v is integrated from the
// middle of the last step to the middle of this one.
class Verlet final : public Stepper {
  public:
    using Stepper::Stepper;

  protected:
    void step(const MotionSystem& system, Points& x, Points& v, double t, double h,
              IntegratorReport& report) override {
        system.acceleration(t, x, v, a_);
        ++report.evaluations;
        v += (0.5 * (before_s_ + h)) * a_;
        x += h * v;
        before_s_ = h;
    }
    void forget() override { before_s_ = 0; }

  private:
    double before_s_ = 0;
    Points a_;
};

class RungeKutta2 final : public Stepper {
  public:
    using Stepper::Stepper;

  protected:
    void step(const MotionSystem& system, Points& x, Points& v, double t, double h,
              IntegratorReport& report) override {
        const double half = 0.5 * h;
        system.acceleration(t, x, v, a_);
        middle_ = x + half * v;
        middle_v_ = v + half * a_;
        system.place_fixed(t + half, middle_, middle_v_);
        system.acceleration(t + half, middle_, middle_v_, a_);
        report.evaluations += 2;
        x += h * middle_v_;
        v += h * a_;
    }

  private:
    Points middle_, middle_v_, a_;
};

class RungeKutta4 final : public Stepper {
  public:
    using Stepper::Stepper;

  protected:
    void step(const MotionSystem& system, Points& x, Points& v, double t, double h,
              IntegratorReport& report) override {
        system.acceleration(t, x, v, a_);
        step_.apply(system, t, h, a_, x, v);
        report.evaluations += 4;
    }

  private:
    RungeKutta4Step step_;
    Points a_;
};

}  // namespace

std::unique_ptr<Integrator> make_euler(const IntegratorOptions& options) {
    return std::make_unique<Euler>(options);
}
std::unique_ptr<Integrator> make_verlet(const IntegratorOptions& options) {
    return std::make_unique<Verlet>(options);
}
std::unique_ptr<Integrator> make_runge_kutta_2(const IntegratorOptions& options) {
    return std::make_unique<RungeKutta2>(options);
}
std::unique_ptr<Integrator> make_runge_kutta_4(const IntegratorOptions& options) {
    return std::make_unique<RungeKutta4>(options);
}

}  // namespace risorius::solve::detail
