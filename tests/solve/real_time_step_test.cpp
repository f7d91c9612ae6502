// SPDX-License-Identifier: MIT
#include "risorius/solve/real_time_step.h"

#include <gtest/gtest.h>

#include "risorius/solve/integrator.h"
#include "toy_terms.h"

namespace risorius::solve {
namespace {

constexpr double kStep = 1.0 / 60;

/// A chain of six nodes, the first held, that falls from the horizontal.
struct FallingChain {
    MotionSystem system{Eigen::VectorXd::Constant(6, 0.1), {1, 0, 0, 0, 0, 0}};
    MotionState state{0, Points::Zero(6, 3), Points::Zero(6, 3)};

    FallingChain() {
        system.add(std::make_shared<toy::Chain>(400.0, 0.1, 0.981));
        for (int i = 0; i < 6; ++i) state.x(i, 0) = 0.1 * i;
    }
    RealTimeStep stepper(int iterations, double accuracy = 0) const {
        return {system, std::make_shared<PrefactoredMetric>(system, kStep),
                RealTimeOptions{.step_s = kStep, .iterations = iterations, .accuracy = accuracy}};
    }
};

TEST(RealTimeStep, IteratedToTheEndItIsTheStepOfNewtonsMethod) {
    FallingChain chain;
    RealTimeStep fast = chain.stepper(300, 1e-9);
    const auto newton = make_integrator(
        {.method = Method::kImplicitEuler, .step_s = kStep, .newton_tolerance = 1e-12});
    for (int step = 1; step <= 10; ++step) {
        MotionState exact = chain.state;
        newton->advance(chain.system, exact, exact.t_s + kStep);
        const StepReport report = fast.advance(chain.state);
        EXPECT_TRUE(report.converged || report.stalled);
        const double motion = chain.state.v.norm() * kStep;
        EXPECT_LT((chain.state.x - exact.x).norm(), 1e-6 * motion) << "step " << step;
        EXPECT_LT((chain.state.v - exact.v).norm() * kStep, 1e-6 * motion) << "step " << step;
    }
}

TEST(RealTimeStep, EveryIterationLowersThePotential) {
    FallingChain chain;
    RealTimeStep begin = chain.stepper(8);
    for (int step = 0; step < 12; ++step) begin.advance(chain.state);
    double last = std::numeric_limits<double>::infinity();
    for (int iterations = 1; iterations <= 10; ++iterations) {
        MotionState state = chain.state;
        RealTimeStep stepper = chain.stepper(iterations);
        const double potential = stepper.advance(state).energy_j;
        EXPECT_LT(potential, last) << iterations;
        last = potential;
    }
}

// Phi(x_n) is the stored energy, loads included, plus the kinetic energy at the start.
TEST(RealTimeStep, AStepCutShortEndsNoHigherThanStandingStill) {
    FallingChain chain;
    RealTimeStep stepper = chain.stepper(1);
    for (int step = 0; step < 200; ++step) {
        // An occasional kick from outside makes the start of the search bad.
        if (step % 37 == 36) chain.state.v.row(5) << 0, 8, -8;
        MotionState before = chain.state;
        const double at_rest =
            chain.system.energy(0, before.x) + chain.system.kinetic_energy(before.v);
        EXPECT_LE(stepper.advance(chain.state).energy_j, at_rest + 1e-12) << step;
    }
}

TEST(RealTimeStep, BeginsWhereTheLastAccelerationLeads) {
    // A free fall needs no iteration except in the first step.
    MotionSystem system(Eigen::VectorXd::Constant(1, 2.0), {});
    auto fall = std::make_shared<toy::Anchor>(0.0, 0.0);
    fall->load = [](double) { return Vec3(0, 0, -19.62); };
    system.add(fall);
    RealTimeStep stepper(system, std::make_shared<PrefactoredMetric>(system, kStep),
                         {.step_s = kStep, .iterations = 1});
    MotionState state{0, Points::Zero(1, 3), Points::Zero(1, 3)};
    EXPECT_EQ(stepper.advance(state).iterations, 1);
    EXPECT_NEAR(state.v(0, 2), -9.81 * kStep, 1e-12);
    const StepReport second = stepper.advance(state);
    EXPECT_LT(second.last_step_rms_m, 1e-15);
    EXPECT_NEAR(state.v(0, 2), -2 * 9.81 * kStep, 1e-12);
}

TEST(RealTimeStep, AStateChangedFromOutsideBeginsAnew) {
    FallingChain chain;
    RealTimeStep used = chain.stepper(2), fresh = chain.stepper(2);
    for (int step = 0; step < 5; ++step) used.advance(chain.state);
    chain.state.v *= 0.5;
    MotionState other = chain.state;
    used.advance(chain.state);
    fresh.advance(other);
    EXPECT_EQ(chain.state.x, other.x);
    EXPECT_EQ(chain.state.v, other.v);
}

TEST(RealTimeStep, TwoRunsGiveTheSameBits) {
    FallingChain one, two;
    RealTimeStep first = one.stepper(3), second = two.stepper(3);
    for (int step = 0; step < 30; ++step) {
        first.advance(one.state);
        second.advance(two.state);
    }
    EXPECT_EQ(one.state.x, two.state.x);
    EXPECT_EQ(one.state.v, two.state.v);
}

TEST(RealTimeStep, HeldNodesGoWhereTheyAreLed) {
    FallingChain chain;
    chain.system.set_boundary_conditions([](double t_s, Points& x, Points& v) {
        x.row(0) << 0, t_s, 0;
        v.row(0) << 0, 1, 0;
    });
    RealTimeStep stepper = chain.stepper(4);
    for (int step = 1; step <= 3; ++step) {
        stepper.advance(chain.state);
        EXPECT_NEAR(chain.state.x(0, 1), step * kStep, 1e-15);
        EXPECT_EQ(chain.state.v(0, 1), 1.0);
    }
}

TEST(RealTimeStep, OptionsOutsideTheirRangesAreRefused) {
    FallingChain chain;
    const auto metric = std::make_shared<PrefactoredMetric>(chain.system, kStep);
    for (const RealTimeOptions& options :
         {RealTimeOptions{.step_s = 0}, RealTimeOptions{.iterations = 0},
          RealTimeOptions{.memory = -1}, RealTimeOptions{.accuracy = -1},
          RealTimeOptions{.length_scale_m = 0}}) {
        try {
            RealTimeStep stepper(chain.system, metric, options);
            ADD_FAILURE() << "accepted";
        } catch (const std::invalid_argument& error) {
            EXPECT_STREQ(error.what(), "RealTimeStep: an option is outside its range");
        }
    }
}

}  // namespace
}  // namespace risorius::solve
