// SPDX-License-Identifier: MIT
#include "risorius/tissue/point_springs.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

#include "force_term_checks.h"
#include "risorius/core/dense_algebra.h"
#include "risorius/core/error.h"
#include "risorius/solve/integrator.h"
#include "risorius/tissue/grid_point.h"

namespace risorius::tissue {
namespace {

using solve::NodeBlend;
using namespace testing_of;

/// Springs of every kind: stretched, compressed, of zero length; at nodes and between them.
std::vector<PointSpring> mixed_springs() {
    return {{NodeBlend(0), {0.1, 0.2, 1.5}, 3.0, 0.4, 0.2},
            {NodeBlend({1, 2, 3}, {0.2, 0.5, 0.3}), {0.1, 0.0, 0.1}, 2.0, 1.5, 0.1},
            {NodeBlend({0, 3}, {0.6, 0.4}), {-1, 0, 0}, 5.0, 0.0, 0.3}};
}

TEST(PointSprings, PullBackByStiffnessTimesLengthening) {
    const PointSprings springs({{NodeBlend(0), {0, 0, 1}, 4.0, 0.5, 0.0}});
    Points x(1, 3), v(1, 3), force = Points::Zero(1, 3);
    x << 0, 0, -1;
    v.setZero();
    springs.add_force(0, x, v, force);
    EXPECT_NEAR(force(0, 2), 4.0 * 1.5, 1e-14);
    EXPECT_NEAR(springs.energy(0, x), 0.5 * 4.0 * 1.5 * 1.5, 1e-14);
}

TEST(PointSprings, ADamperBesideASpringWithLengthResistsOnlyLengthening) {
    const PointSprings springs({{NodeBlend(0), {0, 0, 0}, 4.0, 1.0, 0.5}});
    Points x(1, 3), v(1, 3), force = Points::Zero(1, 3);
    x << 0, 0, -1;  // at its rest length
    v << 2, 0, -3;
    springs.add_force(0, x, v, force);
    EXPECT_NEAR(force(0, 0), 0, 1e-14);
    EXPECT_NEAR(force(0, 2), 0.5 * 3, 1e-14);
}

TEST(PointSprings, ForceIsMinusTheSlopeOfTheEnergy) {
    // Central differences with step 1e-6: the error is about 1e-10.
    expect_force_is_minus_slope_of_energy(PointSprings(mixed_springs()), 0,
                                          random_points(4, 1.0, 3), 1e-6, 1e-8);
}

TEST(PointSprings, GradientAndHessianBelongToThePotentialOfAStep) {
    const Points start = random_points(4, 1.0, 3), x = start + random_points(4, 0.2, 4);
    const solve::ImplicitStep step{0.1, 0.1, start};
    const PointSprings springs(mixed_springs());
    expect_gradient_of_potential(springs, step, x, 1e-6, 1e-8);
    expect_hessian_of_potential(springs, step, x, 1e-5, 1e-7);
}

TEST(PointSprings, AnEquilibriumIsNotDamped) {
    const Points start = random_points(4, 1.0, 3), x = start + random_points(4, 0.2, 4);
    const double forever = std::numeric_limits<double>::infinity();
    Points gradient = Points::Zero(4, 3);
    const PointSprings springs(mixed_springs());
    EXPECT_EQ(springs.add_potential({0, forever, start}, x, gradient), springs.energy(0, x));
}

TEST(PointSprings, APressedSpringIsProjectedToAPositiveMatrix) {
    const PointSprings springs({{NodeBlend(0), {0, 0, 0}, 2.0, 1.0, 0.0}});
    Points x(1, 3);
    x << 0, 0.4, 0;
    const solve::ImplicitStep step{0.1, 0.1, x};
    EXPECT_LT(hessian(springs, step, x, solve::Curvature::kExact)(0, 0), 0);
    EXPECT_NEAR(hessian(springs, step, x, solve::Curvature::kPositive)(1, 1), 2.0, 1e-14);
    expect_projection(springs, step, x);
    const Points mixed = random_points(4, 1.0, 3);
    expect_projection(PointSprings(mixed_springs()), {0.1, 0.1, mixed}, mixed);
}

TEST(PointSprings, SecantMatrixAndLoadMakeUpTheForce) {
    const Points x = random_points(4, 1.0, 3), v = random_points(4, 0.5, 9);
    const PointSprings springs(mixed_springs());
    solve::MetricBuilder K(4), damping(4);
    Points load = Points::Zero(4, 3), force = Points::Zero(4, 3);
    springs.add_secant(0, x, v, false, K, damping, load);
    springs.add_force(0, x, v, force);
    const auto full = [](const solve::MetricBuilder& builder) {
        const Eigen::MatrixXd lower = builder.build({});
        return Eigen::MatrixXd(lower.selfadjointView<Eigen::Lower>());
    };
    const Points sum = load - Points(full(K) * x) - Points(full(damping) * v);
    EXPECT_LT((sum - force).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(PointSprings, MetricBoundsTheCurvature) {
    const PointSprings springs(mixed_springs());
    const Points x = random_points(4, 1.0, 3);
    solve::MetricBuilder metric(4);
    springs.add_metric(0.1, metric);
    const Eigen::MatrixXd lower = metric.build({});
    const Eigen::MatrixXd bound = lower.selfadjointView<Eigen::Lower>();
    Eigen::MatrixXd bound3 = Eigen::MatrixXd::Zero(12, 12);
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            bound3.block<3, 3>(3 * i, 3 * j) = bound(i, j) * Mat3::Identity();
    const Eigen::MatrixXd H = hessian(springs, {0.1, 0.1, x}, x, solve::Curvature::kPositive);
    EXPECT_GE(symmetric_eigenvalues(bound3 - H)(0), -1e-12);
}

TEST(PointSprings, BadNumbersAreNamed) {
    const auto message = [](PointSpring spring) {
        try {
            check(spring, "body.json:/springs/2");
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string("accepted");
    };
    PointSpring spring{NodeBlend(0), {0, 0, 0}, 1.0, 0.0, 0.0};
    EXPECT_EQ(message(spring), "accepted");
    spring.stiffness_n_per_m = -2;
    EXPECT_EQ(message(spring),
              "body.json:/springs/2/stiffness_n_per_m: expected [0, inf), found -2");
    spring.stiffness_n_per_m = 1;
    spring.at = NodeBlend();
    EXPECT_EQ(message(spring),
              "body.json:/springs/2/at: expected a point of the body, found no nodes");
}

TEST(PointOfGrid, IsWhereTheTrilinearMapPutsItAndCornersAreNodes) {
    const GridShape grid{3, 4, 2};
    Points x(grid.size(), 3);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 4; ++j)
            for (int k = 0; k < 2; ++k)
                x.row(grid.index(i, j, k)) << 2.0 * i / 2.0, 3.0 * j / 3.0, 5.0 * k;
    EXPECT_LT((point_of_grid(grid, {0.3, 0.9, 0.25}).of(x) - Vec3(0.6, 2.7, 1.25)).norm(), 1e-14);
    const NodeBlend corner = point_of_grid(grid, {1, 1, 1});
    ASSERT_EQ(corner.count(), 1);
    EXPECT_EQ(corner.node(0), grid.index(2, 3, 1));
    EXPECT_NEAR(point_of_grid(grid, {0.1, 0.5, 0.7}).weight_sum(), 1.0, 1e-15);
}

TEST(InteractiveSpring, FollowsTheCallerFromTheNextStepOnAndLetsGo) {
    InteractiveSpring spring(10.0);
    Points x = Points::Zero(2, 3), v = Points::Zero(2, 3), force = Points::Zero(2, 3);
    EXPECT_EQ(spring.energy(0, x), 0.0);

    spring.attach(NodeBlend(1), {0, 0, 0.5});
    EXPECT_EQ(spring.energy(0, x), 0.0) << "must wait for the step";
    spring.begin_step(0, 0.1, x, v);
    EXPECT_TRUE(spring.attached());
    EXPECT_DOUBLE_EQ(spring.energy(0, x), 0.5 * 10 * 0.25);

    spring.move({0, 0, 1});
    EXPECT_EQ(spring.free_end(), Vec3(0, 0, 0.5)) << "must wait for the step";
    spring.begin_step(0.1, 0.1, x, v);
    spring.add_force(0.1, x, v, force);
    EXPECT_DOUBLE_EQ(force(1, 2), 10.0);
    EXPECT_EQ(force.row(0).norm(), 0.0);

    spring.release();
    spring.move({5, 5, 5});
    spring.begin_step(0.2, 0.1, x, v);
    EXPECT_FALSE(spring.attached());
    EXPECT_EQ(spring.energy(0.2, x), 0.0);
}

TEST(InteractiveSpring, TakesABodyAlongInEveryKindOfStepAndThenLetsItFly) {
    for (const solve::Method method : {solve::Method::kRungeKutta4, solve::Method::kTerzopoulos,
                                       solve::Method::kImplicitEuler}) {
        const auto spring = std::make_shared<InteractiveSpring>(100.0, 2.0);
        solve::MotionSystem system(Eigen::VectorXd::Constant(2, 0.01), {0, 0});
        system.add(spring);
        solve::MotionState state{0, Points::Zero(2, 3), Points::Zero(2, 3)};
        const auto steps = solve::make_integrator({.method = method, .step_s = 1e-3});

        // Pulled at the middle of the two: both follow alike.
        spring->attach(NodeBlend({0, 1}, {0.5, 0.5}), {0, 0, 1});
        steps->advance(system, state, 1.0);
        EXPECT_LT((state.x.row(0) - Eigen::RowVector3d(0, 0, 1)).norm(), 1e-3);
        spring->move({2, 0, 1});
        steps->advance(system, state, 2.0);
        EXPECT_LT((state.x.row(1) - Eigen::RowVector3d(2, 0, 1)).norm(), 1e-3);

        spring->move({3, 0, 1});
        steps->advance(system, state, 2.02);
        spring->release();
        steps->advance(system, state, 2.021);
        const Points v = state.v;
        EXPECT_GT(v(0, 0), 1.0);
        steps->advance(system, state, 2.1);
        EXPECT_LT((state.v - v).norm(), 1e-9) << "nothing holds it any more";
    }
}

TEST(InteractiveSpring, RefusesNegativeStiffness) {
    EXPECT_THROW(InteractiveSpring(-1.0), std::invalid_argument);
}

}  // namespace
}  // namespace risorius::tissue
