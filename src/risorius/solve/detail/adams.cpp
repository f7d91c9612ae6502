// SPDX-License-Identifier: MIT
// Adams-Bashforth of order 4, and Adams-Moulton of order 4 with it as predictor (predict, evaluate, correct, evaluate).
// Source: Hairer, Norsett & Wanner, Solving Ordinary Differential Equations I, III.1.
#include <algorithm>
#include <array>

#include "risorius/solve/detail/methods.h"
#include "risorius/solve/detail/runge_kutta.h"
#include "risorius/solve/detail/stepper.h"

namespace risorius::solve::detail {

namespace {

class Adams final : public Stepper {
  public:
    using Stepper::Stepper;

  protected:
    void step(const MotionSystem& system, Points& x, Points& v, double t, double h,
              IntegratorReport& report) override {
        if (h != step_s_) known_ = 0;  // the formulas need equal steps
        step_s_ = h;
        newest_ = (newest_ + 1) % 4;
        known_ = std::min(known_ + 1, 4);
        past_v_[newest_] = v;
        // This is the last evaluation of the previous step's corrector. It is done here because contacts may have been searched
        // since.
        system.acceleration(t, x, v, past_a_[newest_]);
        ++report.evaluations;
        if (known_ < 4) {
            start_.apply(system, t, h, past_a_[newest_], x, v);
            report.evaluations += 3;
            return;
        }

        const Points &v0 = past_v_[newest_], &v1 = past_v_[(newest_ + 3) % 4],
                     &v2 = past_v_[(newest_ + 2) % 4], &v3 = past_v_[(newest_ + 1) % 4];
        const Points &a0 = past_a_[newest_], &a1 = past_a_[(newest_ + 3) % 4],
                     &a2 = past_a_[(newest_ + 2) % 4], &a3 = past_a_[(newest_ + 1) % 4];
        const double w = h / 24;
        if (options_.method == Method::kAdamsBashforth) {
            x += w * (55 * v0 - 59 * v1 + 37 * v2 - 9 * v3);
            v += w * (55 * a0 - 59 * a1 + 37 * a2 - 9 * a3);
            return;
        }
        predicted_x_ = x + w * (55 * v0 - 59 * v1 + 37 * v2 - 9 * v3);
        predicted_v_ = v + w * (55 * a0 - 59 * a1 + 37 * a2 - 9 * a3);
        system.place_fixed(t + h, predicted_x_, predicted_v_);
        system.acceleration(t + h, predicted_x_, predicted_v_, a_);
        ++report.evaluations;
        x += w * (9 * predicted_v_ + 19 * v0 - 5 * v1 + v2);
        v += w * (9 * a_ + 19 * a0 - 5 * a1 + a2);
        // Milne's error estimate, from the difference between corrector and predictor.
        system.place_fixed(t + h, x, v);
        const double difference = std::max((x - predicted_x_).cwiseAbs().maxCoeff(),
                                           h * (v - predicted_v_).cwiseAbs().maxCoeff());
        report.error_estimate =
            std::max(report.error_estimate, 19. / 270 * difference / options_.length_scale_m);
    }
    void forget() override { known_ = 0; }

  private:
    RungeKutta4Step start_;
    std::array<Points, 4> past_v_, past_a_;  ///< rings
    std::size_t newest_ = 0;
    int known_ = 0;
    double step_s_ = 0;
    Points predicted_x_, predicted_v_, a_;
};

}  // namespace

std::unique_ptr<Integrator> make_adams(const IntegratorOptions& options) {
    return std::make_unique<Adams>(options);
}

}  // namespace risorius::solve::detail
