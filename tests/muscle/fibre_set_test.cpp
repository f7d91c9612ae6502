// SPDX-License-Identifier: MIT
#include "risorius/muscle/fibre_set.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "second_derivative_checks.h"

namespace risorius::muscle {
namespace {

/// Ten nodes in a loose cloud, m.
Points cloud() {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-0.02, 0.02);
    Points x(10, 3);
    for (Eigen::Index i = 0; i < x.size(); ++i) x.data()[i] = uniform(random);
    return x;
}

Points shaken(const Points& x, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-4e-3, 4e-3);
    Points y = x;
    for (Eigen::Index i = 0; i < y.size(); ++i) y.data()[i] += uniform(random);
    return y;
}

FibrePoint in_tissue(std::vector<int> nodes, std::vector<double> weights) {
    FibrePoint point;
    point.count = static_cast<int>(nodes.size());
    for (int i = 0; i < point.count; ++i) {
        point.nodes[i] = nodes[static_cast<std::size_t>(i)];
        point.weights[i] = weights[static_cast<std::size_t>(i)];
    }
    return point;
}

FibrePoint on_bone(int body, const Vec3& rest) {
    FibrePoint point;
    point.body = body;
    point.body_rest = rest;
    return point;
}

/// One fibre from bone through the tissue, and one completely inside it. Two points of the first share a node.
FibreSet two_fibres(bool with_bone = true) {
    std::vector<FibrePoint> points{
        with_bone ? on_bone(1, Vec3(0.03, 0.01, 0)) : in_tissue({9}, {1.0}),
        in_tissue({0, 1, 2, 3}, {0.1, 0.2, 0.3, 0.4}),
        in_tissue({3, 4}, {0.25, 0.75}),
        in_tissue({5}, {1.0}),
        in_tissue({6, 7, 8}, {0.5, 0.25, 0.25}),
        in_tissue({2, 4, 6, 8}, {0.25, 0.25, 0.25, 0.25}),
    };
    std::vector<Fibre> fibres{
        {.first_point = 0, .point_count = 3, .column = 1, .f0_n = 1.5},
        {.first_point = 3, .point_count = 3, .column = 0, .f0_n = 0.7, .rest_stretch = 1.1}};
    return FibreSet(points, fibres, cloud());
}

Eigen::VectorXd activation(double a, double b) {
    Eigen::VectorXd v(2);
    v << a, b;
    return v;
}

TEST(FibreSet, ForcesAreTheSlopeOfTheEnergy) {
    const FibreSet set = two_fibres();
    const Eigen::VectorXd a = activation(0.3, 0.9);
    const Points x = shaken(cloud(), 1);
    Points gradient = Points::Zero(10, 3), ignored = gradient;
    set.add_energy(x, a, gradient);
    const double largest = gradient.cwiseAbs().maxCoeff(), h = 1e-7;
    ASSERT_GT(largest, 0.01);
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        Points above = x, below = x;
        above.data()[i] += h;
        below.data()[i] -= h;
        EXPECT_NEAR(
            (set.add_energy(above, a, ignored) - set.add_energy(below, a, ignored)) / (2 * h),
            gradient.data()[i], 1e-7 * largest);
    }
}

TEST(FibreSet, RelaxedAtRestItDoesNothing) {
    std::vector<FibrePoint> points{on_bone(0, Vec3(0.03, 0, 0)), in_tissue({0}, {1}),
                                   in_tissue({1, 2}, {0.5, 0.5})};
    const FibreSet set(points, {{.first_point = 0, .point_count = 3, .column = 0, .f0_n = 2}},
                       cloud());
    Points gradient = Points::Zero(10, 3);
    // Rounding of the rest length may leave a strain of 1e-16.
    EXPECT_NEAR(set.add_energy(cloud(), Eigen::VectorXd::Zero(1), gradient), 0.0, 1e-18);
    EXPECT_LT(gradient.cwiseAbs().maxCoeff(), 1e-15);
}

TEST(FibreSet, FullyActiveAtOptimalLengthItPullsWithF0) {
    Points x(2, 3);
    x << 0, 0, 0, 0.01, 0, 0;
    const FibreSet set({in_tissue({0}, {1}), in_tissue({1}, {1})},
                       {{.first_point = 0, .point_count = 2, .column = 0, .f0_n = 2.5}}, x);
    Points gradient = Points::Zero(2, 3);
    set.add_energy(x, Eigen::VectorXd::Ones(1), gradient);
    // The gradient at the far end points away; the force on it, -gradient, pulls it in.
    EXPECT_DOUBLE_EQ(gradient(1, 0), 2.5);
    EXPECT_DOUBLE_EQ(gradient(0, 0), -2.5);
    EXPECT_EQ(gradient(1, 1), 0.0);
}

TEST(FibreSet, InternalForcesAddUpToNothing) {
    const FibreSet set = two_fibres(false);
    const Points x = shaken(cloud(), 2);
    Points gradient = Points::Zero(10, 3);
    set.add_energy(x, activation(0.8, 0.4), gradient);
    Vec3 torque = Vec3::Zero();
    for (int i = 0; i < 10; ++i)
        torque += Vec3(x.row(i).transpose()).cross(Vec3(gradient.row(i).transpose()));
    EXPECT_GT(gradient.cwiseAbs().maxCoeff(), 0.01);
    EXPECT_LT(gradient.colwise().sum().norm(), 1e-14);
    EXPECT_LT(torque.norm(), 1e-15);
}

TEST(FibreSet, MovingTissueAndBoneTogetherChangesNothing) {
    FibreSet set = two_fibres();
    const Eigen::VectorXd a = activation(0.5, 0.5);
    const Points x = shaken(cloud(), 3);
    Points ignored = Points::Zero(10, 3);
    const double before = set.add_energy(x, a, ignored);
    Rigid motion = Rigid::Identity();
    motion.rotate(Eigen::AngleAxisd(0.7, Vec3(1, 1, 0).normalized()));
    motion.pretranslate(Vec3(0.01, 0.02, -0.03));
    const Rigid bodies[2] = {Rigid::Identity(), motion};
    set.set_body_positions(bodies);
    Points y(10, 3);
    for (int i = 0; i < 10; ++i) y.row(i) = (motion * Vec3(x.row(i).transpose())).transpose();
    EXPECT_NEAR(set.add_energy(y, a, ignored), before, 1e-13 * std::abs(before));
    EXPECT_GT(std::abs(set.add_energy(x, a, ignored) - before), 1e-4 * std::abs(before));
}

TEST(FibreSet, MeanStretchIsLengthOverOptimalLength) {
    const FibreSet set = two_fibres(false);
    const Eigen::VectorXd rest = set.mean_stretch(cloud());
    EXPECT_NEAR(rest[0], 1.0, 1e-14);
    EXPECT_NEAR(rest[1], 1.1, 1e-14);
    EXPECT_NEAR(set.mean_stretch(0.8 * cloud())[0], 0.8, 1e-14);
}

TEST(FibreSet, TheMetricIsHalfF0OverOptimalLengthAcrossEachSegment) {
    const FibreSet set = two_fibres();
    solve::MetricBuilder builder(10);
    set.add_metric(builder);
    const Eigen::MatrixXd lower = builder.build({});
    const Eigen::MatrixXd metric = lower.selfadjointView<Eigen::Lower>();
    const Points rest = cloud(), points = set.positions(rest);
    // v . A v, compared with the sum over the segments.
    const Eigen::VectorXd v = rest.col(1);
    const FibreSet& f = set;
    double expected = 0;
    for (const Fibre& fibre : f.fibres())
        for (int p = fibre.first_point; p < fibre.first_point + fibre.point_count - 1; ++p) {
            const double l0 = (points.row(p + 1) - points.row(p)).norm() / fibre.rest_stretch;
            double difference = 0;
            for (int end = 0; end < 2; ++end) {
                const FibrePoint& point = f.points()[static_cast<std::size_t>(p + end)];
                for (int i = 0; i < point.count; ++i)
                    difference += (end ? 1 : -1) * point.weights[i] * v[point.nodes[i]];
            }
            expected += 0.5 * fibre.f0_n / l0 * difference * difference;
        }
    EXPECT_NEAR(v.dot(metric * v), expected, 1e-12 * expected);
}

Eigen::VectorXd pair(double first, double second) {
    Eigen::VectorXd a(2);
    a << first, second;
    return a;
}

TEST(FibreSet, InAStepTheGradientIsTheSlopeOfTheEnergy) {
    FibreSet set = two_fibres();
    const Eigen::VectorXd a = pair(0.4, 0.9);
    set.begin_step(cloud(), 1.0 / 60);
    const Points x = shaken(cloud(), 3);
    Points gradient = Points::Zero(10, 3), ignored = gradient;
    set.add_energy(x, a, gradient);
    const double h = 1e-8;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        Points up = x, down = x;
        up.data()[i] += h;
        down.data()[i] -= h;
        const double slope =
            (set.add_energy(up, a, ignored) - set.add_energy(down, a, ignored)) / (2 * h);
        EXPECT_NEAR(gradient.data()[i], slope, 1e-6) << i;
    }
}

TEST(FibreSet, WhatRestsInAStepRestsAtRest) {
    FibreSet set = two_fibres();
    const Eigen::VectorXd a = pair(0.4, 0.9);
    const Points x = shaken(cloud(), 3);
    Points at_rest = Points::Zero(10, 3), in_step = at_rest, again = at_rest;
    set.add_energy(x, a, at_rest);
    set.begin_step(x, 1.0 / 60);
    set.add_energy(x, a, in_step);
    EXPECT_TRUE(in_step.isApprox(at_rest, 1e-6));  // steps read their curves from tables
    set.end_step();
    set.add_energy(x, a, again);
    EXPECT_EQ(again, at_rest);
}

// One active fibre of optimal length 10 mm between two nodes, lengthened or shortened within a step.
TEST(FibreSet, AMovingFibrePullsAsHillsLawSays) {
    Points x(2, 3);
    x << 0, 0, 0, 0.01, 0, 0;
    FibreSet set({in_tissue({0}, {1}), in_tissue({1}, {1})},
                 {{.point_count = 2, .f0_n = 2, .max_speed_hz = 8}}, x);
    const double h = 0.01;
    set.begin_step(x, h);
    const Eigen::VectorXd a = Eigen::VectorXd::Constant(1, 0.5);
    double before = 0;
    for (const double v : {-1.5, -0.5, -0.25, 0.0, 0.1}) {
        Points moved = x, gradient = Points::Zero(2, 3);
        // Speed relative to the maximum of 8 optimal lengths per second.
        moved(1, 0) += v * 8 * 0.01 * h;
        const double energy = set.add_energy(moved, a, gradient);
        const double passive = LengthCurves(HillShape{}).passive(moved(1, 0) / 0.01).force;
        const double hill = v <= -1.1 ? 0
                            : v <= 0  ? (1 + v) / (1 - 4 * v)
                                      : 1.4 - 0.4 / (1 + 12.5 * v);
        // The error of the table is 1e-5.
        EXPECT_NEAR(gradient(1, 0), 2 * (0.5 * hill + passive), 1e-6) << "v = " << v;
        EXPECT_GE(gradient(1, 0), before) << "v = " << v;  // convex
        before = gradient(1, 0);
        if (v < 0) {
            EXPECT_LT(energy, 0);
        }
    }
}

TEST(FibreSet, TheMetricOfAStepCountsOnATenthOfTheResistanceToSpeed) {
    Points x(2, 3);
    x << 0, 0, 0, 0.01, 0, 0;
    const FibreSet set({in_tissue({0}, {1}), in_tissue({1}, {1})},
                       {{.point_count = 2, .f0_n = 2, .max_speed_hz = 10}}, x);
    solve::MetricBuilder builder(2);
    set.add_metric(builder, 1.0 / 60);
    const Eigen::MatrixXd lower = builder.build({});
    EXPECT_NEAR(lower(0, 0), 2 / 0.01 * (0.5 + 0.1 * 5 * 6), 1e-9);
}

TEST(FibreSet, AFibreOfOnePointIsRefused) {
    try {
        FibreSet({in_tissue({0}, {1})}, {{.first_point = 0, .point_count = 1}}, cloud());
        FAIL() << "accepted";
    } catch (const std::invalid_argument& error) {
        EXPECT_STREQ(error.what(), "FibreSet: fibre 0 needs two or more of the points given");
    }
}

TEST(FibreSet, APointOfTwoFibresIsRefused) {
    try {
        FibreSet({in_tissue({0}, {1}), in_tissue({1}, {1}), in_tissue({2}, {1})},
                 {{.first_point = 0, .point_count = 2}, {.first_point = 1, .point_count = 2}},
                 cloud());
        FAIL() << "accepted";
    } catch (const std::invalid_argument& error) {
        EXPECT_STREQ(error.what(), "FibreSet: fibre 1 has a point of another");
    }
}

TEST(FibreSet, ASegmentWithoutLengthIsRefused) {
    try {
        FibreSet({in_tissue({0}, {1}), in_tissue({0}, {1})}, {{.first_point = 0, .point_count = 2}},
                 cloud());
        FAIL() << "accepted";
    } catch (const std::invalid_argument& error) {
        EXPECT_STREQ(error.what(), "FibreSet: fibre 0 has a segment without length");
    }
}

TEST(FibreSet, SecondDerivativesAreTheSlopeOfItsForces) {
    FibreSet set = two_fibres();
    const Eigen::VectorXd activation = Eigen::Vector2d(0.6, 1.0);
    const Points x = shaken(cloud(), 31);
    const auto second = [&](solve::Curvature curvature) {
        return testing_of::dense_second(x.rows(), [&](solve::HessianBuilder& builder) {
            set.add_hessian(x, activation, curvature, builder);
        });
    };
    const Eigen::MatrixXd exact = second(solve::Curvature::kExact);
    testing_of::expect_slope_of_gradient(
        exact, x, [&](const Points& y, Points& g) { return set.add_energy(y, activation, g); },
        1e-8, 1e-6);
    testing_of::expect_positive_part(second(solve::Curvature::kPositive), exact);
}

}  // namespace
}  // namespace risorius::muscle
