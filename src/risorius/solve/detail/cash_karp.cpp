// SPDX-License-Identifier: MIT
// Cash & Karp 1990, ACM TOMS 16(3), 201-222: six evaluations, order 5, with an embedded order 4.
#include <algorithm>
#include <array>
#include <cmath>

#include "risorius/solve/detail/methods.h"
#include "risorius/solve/detail/stepper.h"

namespace risorius::solve::detail {

namespace {

constexpr std::array<double, 6> kNode = {0, 1. / 5, 3. / 10, 3. / 5, 1, 7. / 8};
constexpr double kB[6][5] = {
    {0, 0, 0, 0, 0},
    {1. / 5, 0, 0, 0, 0},
    {3. / 40, 9. / 40, 0, 0, 0},
    {3. / 10, -9. / 10, 6. / 5, 0, 0},
    {-11. / 54, 5. / 2, -70. / 27, 35. / 27, 0},
    {1631. / 55296, 175. / 512, 575. / 13824, 44275. / 110592, 253. / 4096}};
// Weights of order 5. The second weight is zero in both orders.
constexpr double kC[6] = {37. / 378, 0, 250. / 621, 125. / 594, 0, 512. / 1771};
// Weights of order 5 minus those of order 4.
constexpr double kE[6] = {37. / 378 - 2825. / 27648,
                          0,
                          250. / 621 - 18575. / 48384,
                          125. / 594 - 13525. / 55296,
                          -277. / 14336,
                          512. / 1771 - 1. / 4};

/// The stages. k = 0 is (v, a) at the start.
class Stages {
  public:
    void first(const MotionSystem& system, double t, const Points& x, const Points& v) {
        v_[0] = v;
        system.acceleration(t, x, v, a_[0]);
    }

    void others(const MotionSystem& system, double t, double h, const Points& x) {
        const auto evaluate = [&](std::size_t k) {
            const double stage_s = t + kNode[k] * h;
            system.place_fixed(stage_s, x_, v_[k]);
            system.acceleration(stage_s, x_, v_[k], a_[k]);
        };
        // The sums are unrolled so that each stage is one pass over the nodes.
        const auto sum1 = [&](const std::array<Points, 6>& y, const double* b) {
            return h * b[0] * y[0];
        };
        const auto sum2 = [&](const std::array<Points, 6>& y, const double* b) {
            return h * b[0] * y[0] + h * b[1] * y[1];
        };
        const auto sum3 = [&](const std::array<Points, 6>& y, const double* b) {
            return h * b[0] * y[0] + h * b[1] * y[1] + h * b[2] * y[2];
        };
        const auto sum4 = [&](const std::array<Points, 6>& y, const double* b) {
            return h * b[0] * y[0] + h * b[1] * y[1] + h * b[2] * y[2] + h * b[3] * y[3];
        };
        const auto sum5 = [&](const std::array<Points, 6>& y, const double* b) {
            return h * b[0] * y[0] + h * b[1] * y[1] + h * b[2] * y[2] + h * b[3] * y[3] +
                   h * b[4] * y[4];
        };
        x_ = x + sum1(v_, kB[1]);
        v_[1] = v_[0] + sum1(a_, kB[1]);
        evaluate(1);
        x_ = x + sum2(v_, kB[2]);
        v_[2] = v_[0] + sum2(a_, kB[2]);
        evaluate(2);
        x_ = x + sum3(v_, kB[3]);
        v_[3] = v_[0] + sum3(a_, kB[3]);
        evaluate(3);
        x_ = x + sum4(v_, kB[4]);
        v_[4] = v_[0] + sum4(a_, kB[4]);
        evaluate(4);
        x_ = x + sum5(v_, kB[5]);
        v_[5] = v_[0] + sum5(a_, kB[5]);
        evaluate(5);
    }

    /// Adds the step of order 5 to x and v.
    void add_step(double h, Points& x, Points& v) const {
        x += h * kC[0] * v_[0] + h * kC[2] * v_[2] + h * kC[3] * v_[3] + h * kC[5] * v_[5];
        v += h * kC[0] * a_[0] + h * kC[2] * a_[2] + h * kC[3] * a_[3] + h * kC[5] * a_[5];
    }
    /// The step of order 5 minus that of order 4.
    void difference(double h, Points& dx, Points& dv) const {
        dx = h * kE[0] * v_[0] + h * kE[2] * v_[2] + h * kE[3] * v_[3] + h * kE[4] * v_[4] +
             h * kE[5] * v_[5];
        dv = h * kE[0] * a_[0] + h * kE[2] * a_[2] + h * kE[3] * a_[3] + h * kE[4] * a_[4] +
             h * kE[5] * a_[5];
    }

  private:
    std::array<Points, 6> v_, a_;
    Points x_;
};

class FixedCashKarp final : public Stepper {
  public:
    using Stepper::Stepper;

  protected:
    void step(const MotionSystem& system, Points& x, Points& v, double t, double h,
              IntegratorReport& report) override {
        stages_.first(system, t, x, v);
        stages_.others(system, t, h, x);
        report.evaluations += 6;
        stages_.add_step(h, x, v);
        stages_.difference(h, dx_, dv_);
        const double error = std::max(dx_.cwiseAbs().maxCoeff(), h * dv_.cwiseAbs().maxCoeff());
        report.error_estimate = std::max(report.error_estimate, error / options_.length_scale_m);
    }

  private:
    Stages stages_;
    Points dx_, dv_;
};

class ControlledCashKarp final : public ControlledStepper {
  public:
    using ControlledStepper::ControlledStepper;

  protected:
    Attempt attempt(const MotionSystem& system, const Points& x, const Points& v, double t,
                    double h, bool first, IntegratorReport& report) override {
        if (first) stages_.first(system, t, x, v);
        stages_.others(system, t, h, x);
        report.evaluations += first ? 6 : 5;
        trial_x_ = x;
        trial_v_ = v;
        stages_.add_step(h, trial_x_, trial_v_);
        stages_.difference(h, dx_, dv_);
        const double error = scaled_error(dx_, dv_, h);

        // Exponents of an accepted and of a rejected step from Numerical Recipes 17.2. Growth and shrinking are limited.
        constexpr double kSafety = 0.9, kGrowth = 5, kShrink = 0.1;
        double factor = kShrink;
        if (error <= 1)
            factor = error > 0 ? std::min(kGrowth, kSafety * std::pow(error, -0.2)) : kGrowth;
        else if (std::isfinite(error))
            factor = std::max(kShrink, kSafety * std::pow(error, -0.25));
        return {error, factor * h};
    }

  private:
    Stages stages_;
    Points dx_, dv_;
};

}  // namespace

std::unique_ptr<Integrator> make_cash_karp(const IntegratorOptions& options) {
    if (options.tolerance > 0) return std::make_unique<ControlledCashKarp>(options);
    return std::make_unique<FixedCashKarp>(options);
}

}  // namespace risorius::solve::detail
