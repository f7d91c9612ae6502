// SPDX-License-Identifier: MIT
// Order, stability limits, step control and counts of the explicit methods.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "risorius/solve/integrator.h"
#include "toy_terms.h"

namespace risorius::solve {
namespace {

using toy::Anchor;

constexpr Method kExplicit[] = {
    Method::kEuler,    Method::kVerlet,        Method::kRungeKutta2,    Method::kRungeKutta4,
    Method::kCashKarp, Method::kBulirschStoer, Method::kAdamsBashforth, Method::kAdamsMoulton};

/// x'' = - w^2 x - d x' from (x0, v0): x and v at t.
struct Oscillator {
    double w, d, x0, v0;
    double x(double t) const {
        const double r = std::sqrt(w * w - d * d / 4);
        return std::exp(-d * t / 2) *
               (x0 * std::cos(r * t) + (v0 + d / 2 * x0) / r * std::sin(r * t));
    }
};

double error_at_end(Method method, double h, double damping, double tolerance = 0,
                    IntegratorReport* report = nullptr) {
    const Oscillator exact{3.0, damping, 0.4, 1.1};
    const double mass = 2.0;
    const MotionSystem system =
        toy::system_of(1, mass, std::make_shared<Anchor>(mass * exact.w * exact.w, mass * exact.d));
    MotionState state = toy::at_rest(Points::Zero(1, 3));
    state.x(0, 0) = exact.x0;
    state.v(0, 0) = exact.v0;
    const auto integrator =
        make_integrator({.method = method, .step_s = h, .tolerance = tolerance});
    const IntegratorReport done = integrator->advance(system, state, 2.0);
    if (report) *report = done;
    EXPECT_EQ(state.t_s, 2.0);
    return std::abs(state.x(0, 0) - exact.x(2.0));
}

TEST(ExplicitMethods, HalvingTheStepShowsTheOrderOfEachMethod) {
    const struct {
        Method method;
        double order, damping;
    } cases[] = {
        {Method::kEuler, 1, 0.5},        {Method::kVerlet, 2, 0},
        {Method::kVerlet, 1, 0.5},  // the velocity used for the damping is half a step old
        {Method::kRungeKutta2, 2, 0.5},  {Method::kRungeKutta4, 4, 0.5},
        {Method::kCashKarp, 5, 0.5},     {Method::kAdamsBashforth, 4, 0.5},
        {Method::kAdamsMoulton, 4, 0.5},
    };
    for (const auto& [method, order, damping] : cases) {
        const double h = order == 1 ? 1.0 / 2048 : 1.0 / 128;
        const double observed =
            std::log2(error_at_end(method, h, damping) / error_at_end(method, h / 2, damping));
        EXPECT_NEAR(observed, order, 0.15) << name_of(method) << " damping " << damping;
    }
}

/// Maximum step with which x'' = -w^2 x - d x' stays bounded, by bisection.
double max_stable_step(Method method, double w, double d, double min, double max) {
    const MotionSystem system = toy::system_of(1, 1.0, std::make_shared<Anchor>(w * w, d));
    for (int halving = 0; halving < 12; ++halving) {
        const double h = std::sqrt(min * max);
        MotionState state = toy::at_rest(Points::Ones(1, 3));
        const auto integrator = make_integrator({.method = method, .step_s = h});
        const bool stable = !integrator->advance(system, state, 20000 * h).diverged;
        (stable ? min : max) = h;
    }
    return min;
}

TEST(ExplicitMethods, StabilityLimitsAreThoseOfTheLinearTheory) {
    // Undamped, w = 10: theory of the test equation, Hairer & Wanner II, IV.2.
    EXPECT_NEAR(max_stable_step(Method::kRungeKutta4, 10, 0, 0.05, 1) * 10, 2.83, 0.03);
    EXPECT_NEAR(max_stable_step(Method::kVerlet, 10, 0, 0.05, 1) * 10, 2.0, 0.02);
    // Damping dominates, w << d = 100.
    EXPECT_NEAR(max_stable_step(Method::kEuler, 1, 100, 1e-3, 1) * 100, 2.0, 0.02);
    EXPECT_NEAR(max_stable_step(Method::kRungeKutta4, 1, 100, 1e-3, 1) * 100, 2.785, 0.03);
    // Interval of absolute stability of Adams-Bashforth 4: (-0.3, 0).
    EXPECT_NEAR(max_stable_step(Method::kAdamsBashforth, 1, 100, 1e-3, 1) * 100, 0.3, 0.01);
}

TEST(ExplicitMethods, EulerAndMidpointGrowWithoutDamping) {
    const double w = 10;
    const MotionSystem system = toy::system_of(1, 1.0, std::make_shared<Anchor>(w * w, 0.0));
    for (const auto& [method, growth] :
         {std::pair{Method::kEuler, std::sqrt(1 + 0.01)},
          std::pair{Method::kRungeKutta2, std::sqrt(1 + 0.0001 / 4)}}) {
        MotionState state = toy::at_rest(Points::Zero(1, 3));
        state.x(0, 0) = 1;
        const auto integrator = make_integrator({.method = method, .step_s = 0.1 / w});
        integrator->advance(system, state, 1000 * 0.1 / w);
        const double radius = std::hypot(state.x(0, 0), state.v(0, 0) / w);
        EXPECT_NEAR(radius / std::pow(growth, 1000), 1, 1e-9) << name_of(method);
    }
}

TEST(ExplicitMethods, StepControlMeetsItsTolerance) {
    for (const Method method : {Method::kCashKarp, Method::kBulirschStoer}) {
        for (const double tolerance : {1e-5, 1e-7, 1e-9}) {
            IntegratorReport report;
            const double error = error_at_end(method, 1e-4, 0.5, tolerance, &report);
            // One and a half periods: the errors of the steps add up.
            EXPECT_LT(error, tolerance * static_cast<double>(report.steps))
                << name_of(method) << " " << tolerance;
            EXPECT_LE(report.error_estimate, tolerance);
            EXPECT_LT(report.steps, 2000);
            EXPECT_TRUE(report.converged);
        }
    }
}

TEST(ExplicitMethods, TooLongAFirstStepIsRejected) {
    for (const Method method : {Method::kCashKarp, Method::kBulirschStoer}) {
        IntegratorReport report;
        const double error = error_at_end(method, 2.0, 0.5, 1e-8, &report);
        EXPECT_GT(report.rejections, 0) << name_of(method);
        EXPECT_LT(error, 1e-8 * static_cast<double>(report.steps)) << name_of(method);
    }
}

TEST(ExplicitMethods, ExtrapolationTakesFewerEvaluationsThanCashKarpForTightTolerances) {
    IntegratorReport extrapolated, embedded;
    error_at_end(Method::kBulirschStoer, 0.01, 0.5, 1e-11, &extrapolated);
    error_at_end(Method::kCashKarp, 0.01, 0.5, 1e-11, &embedded);
    EXPECT_LT(extrapolated.evaluations, embedded.evaluations);
}

TEST(ExplicitMethods, AStepThatMustShrinkForeverIsDivergence) {
    // The load jumps to infinity at 0.5 s.
    auto anchor = std::make_shared<Anchor>(1.0, 0.0);
    anchor->load = [](double t) {
        return t > 0.5 ? Vec3::Constant(std::numeric_limits<double>::infinity()) : Vec3::Zero();
    };
    const MotionSystem system = toy::system_of(1, 1.0, anchor);
    for (const Method method : {Method::kCashKarp, Method::kBulirschStoer}) {
        MotionState state = toy::at_rest(Points::Ones(1, 3));
        const auto integrator =
            make_integrator({.method = method, .step_s = 0.01, .tolerance = 1e-6});
        const IntegratorReport report = integrator->advance(system, state, 1.0);
        EXPECT_TRUE(report.diverged) << name_of(method);
        EXPECT_NEAR(report.diverged_at_s, 0.5, 1e-6) << name_of(method);
        EXPECT_NEAR(state.x(0, 0), std::cos(0.5), 1e-5) << name_of(method);
    }
}

TEST(ExplicitMethods, DivergenceIsReportedWithItsTimeAndStopsThere) {
    // Euler at h = 3/d multiplies v by -2 in each step.
    const MotionSystem system = toy::system_of(2, 1.0, std::make_shared<Anchor>(0.0, 1.0));
    MotionState state = toy::at_rest(Points::Zero(2, 3));
    state.v(1, 2) = 1;
    const auto integrator =
        make_integrator({.method = Method::kEuler, .step_s = 3.0, .diverged_at = 20});
    // x = 3 - 6 + 12 - 24 ... = 3, -3, 9, -15, 33
    const IntegratorReport report = integrator->advance(system, state, 3000);
    EXPECT_TRUE(report.diverged);
    EXPECT_EQ(report.diverged_at_s, 15);
    EXPECT_EQ(report.steps, 5);
    EXPECT_EQ(state.t_s, 15);
    EXPECT_EQ(state.x(1, 2), 33);
    const IntegratorReport again = integrator->advance(system, state, 3000);
    EXPECT_TRUE(again.diverged);
    EXPECT_EQ(again.steps, 0);
    EXPECT_EQ(state.x(1, 2), 33);
}

TEST(ExplicitMethods, AForceThatIsNoNumberIsDivergence) {
    for (const Method method : kExplicit) {
        auto anchor = std::make_shared<Anchor>(1.0, 0.0);
        anchor->load = [](double t) { return Vec3::Constant(t > 0.45 ? std::nan("") : 0.0); };
        const MotionSystem system = toy::system_of(1, 1.0, anchor);
        MotionState state = toy::at_rest(Points::Ones(1, 3));
        const IntegratorReport report =
            make_integrator({.method = method, .step_s = 0.1})->advance(system, state, 1.0);
        EXPECT_TRUE(report.diverged) << name_of(method);
        EXPECT_LT(report.diverged_at_s, 0.71) << name_of(method);
    }
}

TEST(ExplicitMethods, FixedAndPrescribedNodesAreWhereTheyAreToldAtEveryStage) {
    struct Witness : Anchor {
        Witness() : Anchor(5.0, 0.1) {}
        void add_force(double t_s, const Points& x, const Points& v, Points& force) const override {
            EXPECT_NEAR(x(0, 0), std::sin(t_s), 1e-14);
            EXPECT_NEAR(v(0, 0), std::cos(t_s), 1e-14);
            EXPECT_EQ(x(1, 1), 7.0);
            EXPECT_EQ(v(1, 1), 0.0);
            Anchor::add_force(t_s, x, v, force);
        }
    };
    MotionSystem system = toy::system_of(3, 1.0, std::make_shared<Witness>(), {1, 1, 0});
    system.set_boundary_conditions([](double t_s, Points& x, Points& v) {
        x(0, 0) = std::sin(t_s);
        v(0, 0) = std::cos(t_s);
    });
    for (const Method method : kExplicit) {
        MotionState state = toy::at_rest(Points::Ones(3, 3));
        state.x(1, 1) = 7;
        state.v(1, 1) = 3;  // a fixed node does not have this velocity
        make_integrator({.method = method, .step_s = 0.03})->advance(system, state, 0.5);
        EXPECT_EQ(state.x(0, 0), std::sin(0.5)) << name_of(method);
        EXPECT_EQ(state.x(1, 1), 7.0) << name_of(method);
        EXPECT_EQ(state.v(1, 1), 0.0) << name_of(method);
    }
}

TEST(ExplicitMethods, AdvancingInPiecesOfWholeStepsRepeatsTheSameBits) {
    auto anchor = std::make_shared<Anchor>(50.0, 0.3);
    anchor->load = [](double t) { return Vec3(std::sin(3 * t), t, 1); };
    const MotionSystem system = toy::system_of(4, 0.7, anchor);
    Points x0 = Points::Random(4, 3);
    for (const Method method : kExplicit) {
        if (method == Method::kBulirschStoer) continue;  // it chooses its own steps
        const double h = 0.01;
        MotionState whole = toy::at_rest(x0), pieces = toy::at_rest(x0);
        const auto one = make_integrator({.method = method, .step_s = h});
        const auto other = make_integrator({.method = method, .step_s = h});
        const IntegratorReport report = one->advance(system, whole, 1.0);
        IntegratorReport sum;
        for (int k = 1; k <= 20; ++k) sum.add(other->advance(system, pieces, 0.05 * k));
        EXPECT_EQ(whole.t_s, pieces.t_s);
        EXPECT_EQ(whole.x, pieces.x) << name_of(method);
        EXPECT_EQ(whole.v, pieces.v) << name_of(method);
        EXPECT_EQ(report.steps, 100);
        EXPECT_EQ(sum.steps, 100);
        EXPECT_EQ(report.evaluations, sum.evaluations);
    }
}

TEST(ExplicitMethods, TheLastStepIsShortenedToEndOnTime) {
    for (const Method method : kExplicit) {
        const MotionSystem system = toy::system_of(1, 1.0, std::make_shared<Anchor>(9.0, 0.0));
        MotionState state = toy::at_rest(Points::Ones(1, 3));
        const auto integrator = make_integrator({.method = method, .step_s = 1e-3});
        for (const double until : {0.01037, 0.0204, 0.3}) {
            integrator->advance(system, state, until);
            EXPECT_EQ(state.t_s, until);
            EXPECT_NEAR(state.x(0, 0), std::cos(3 * until),
                        6e-4 + (method == Method::kEuler) * 2e-3)
                << name_of(method);
        }
    }
}

TEST(ExplicitMethods, TheStateMayBeChangedAfterARestart) {
    for (const Method method : kExplicit) {
        const MotionSystem system = toy::system_of(1, 1.0, std::make_shared<Anchor>(9.0, 0.2));
        const auto used = make_integrator({.method = method, .step_s = 1e-2});
        MotionState state = toy::at_rest(Points::Ones(1, 3));
        used->advance(system, state, 0.5);
        MotionState again = toy::at_rest(Points::Constant(1, 3, 2.0));
        again.t_s = 0.5;
        MotionState fresh = again;
        used->restart();
        used->advance(system, again, 1.0);
        make_integrator({.method = method, .step_s = 1e-2})->advance(system, fresh, 1.0);
        EXPECT_EQ(again.x, fresh.x) << name_of(method);
        EXPECT_EQ(again.v, fresh.v) << name_of(method);
    }
}

TEST(ExplicitMethods, ReportsCountWhatTheTermsSaw) {
    const struct {
        Method method;
        long per_step;
    } cases[] = {{Method::kEuler, 1},          {Method::kVerlet, 1},
                 {Method::kRungeKutta2, 2},    {Method::kRungeKutta4, 4},
                 {Method::kCashKarp, 6},       {Method::kBulirschStoer, 0},
                 {Method::kAdamsBashforth, 1}, {Method::kAdamsMoulton, 2}};
    for (const auto& [method, per_step] : cases) {
        auto anchor = std::make_shared<Anchor>(9.0, 0.2);
        const MotionSystem system = toy::system_of(2, 1.0, anchor);
        MotionState state = toy::at_rest(Points::Ones(2, 3));
        const IntegratorReport report =
            make_integrator({.method = method, .step_s = 1e-2})->advance(system, state, 1.0);
        EXPECT_EQ(report.evaluations, anchor->forces) << name_of(method);
        EXPECT_EQ(report.steps, anchor->begun) << name_of(method);
        if (per_step == 0) continue;
        EXPECT_EQ(report.steps, 100);
        // Three steps of Runge-Kutta start the multi-step methods.
        const long start = method == Method::kAdamsBashforth ? 9
                           : method == Method::kAdamsMoulton ? 6
                                                             : 0;
        EXPECT_EQ(report.evaluations, 100 * per_step + start) << name_of(method);
    }
}

}  // namespace
}  // namespace risorius::solve
