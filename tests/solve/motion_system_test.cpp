// SPDX-License-Identifier: MIT
// Sums over terms, masses and fixed nodes.
#include "risorius/solve/motion_system.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "toy_terms.h"

namespace risorius::solve {
namespace {

std::string refusal(Eigen::VectorXd mass, std::vector<char> fixed) {
    try {
        MotionSystem system(std::move(mass), std::move(fixed));
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

TEST(MotionSystem, EveryFreeNodeNeedsAMass) {
    Eigen::VectorXd mass = Eigen::VectorXd::Ones(3);
    EXPECT_EQ(refusal(mass, {}), "");
    EXPECT_EQ(refusal(mass, {0, 1}), "one fixed flag per node is needed");
    for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
        mass[1] = bad;
        EXPECT_EQ(refusal(mass, {}), "node 1 is free and has no mass");
        EXPECT_EQ(refusal(mass, {0, 1, 0}), "") << "a fixed node needs none";
    }
}

TEST(MotionSystem, AccelerationIsForceOverMassAndNoneWhereFixed) {
    MotionSystem system(Eigen::Vector3d(2, 0, 4), {0, 1, 0});
    system.add(std::make_shared<toy::Anchor>(8.0, 0.0));
    system.add(std::make_shared<toy::Anchor>(0.0, 3.0));
    const Points x = Points::Constant(3, 3, 0.5), v = Points::Constant(3, 3, 2.0);
    Points f, a;
    system.force(0, x, v, f);
    EXPECT_EQ(f, Points::Constant(3, 3, -10.0));
    system.acceleration(0, x, v, a);
    EXPECT_EQ(a(0, 0), -5.0);
    EXPECT_EQ(a.row(1).norm(), 0.0);
    EXPECT_EQ(a(2, 2), -2.5);
    EXPECT_EQ(system.kinetic_energy(v), 0.5 * (2 + 4) * 12);
    EXPECT_EQ(system.energy(0, x), 0.5 * 8 * 9 * 0.25);
}

TEST(MotionSystem, FixedNodesStandStillUnlessPrescribed) {
    MotionSystem system(Eigen::VectorXd::Ones(3), {1, 0, 1});
    system.set_boundary_conditions([](double t, Points& x, Points& v) {
        x.row(2) << t, 0, 0;
        v.row(2) << 1, 0, 0;
    });
    Points x = Points::Constant(3, 3, 9.0), v = Points::Constant(3, 3, 7.0);
    system.place_fixed(0.25, x, v);
    EXPECT_EQ(x.row(0), Eigen::RowVector3d::Constant(9));
    EXPECT_EQ(v.row(0).norm(), 0);
    EXPECT_EQ(x.row(1), Eigen::RowVector3d::Constant(9));
    EXPECT_EQ(v.row(1), Eigen::RowVector3d::Constant(7));
    EXPECT_EQ(x(2, 0), 0.25);
    EXPECT_EQ(v(2, 0), 1.0);
}

TEST(MotionSystem, ThePotentialsDerivativesAgreeWithDifferences) {
    const int n = 5;
    MotionSystem system(Eigen::VectorXd::Ones(n), toy::first_fixed(n));
    system.add(std::make_shared<toy::Chain>(30.0, 0.2, 0.7));
    system.add(std::make_shared<toy::Anchor>(3.0, 0.4));
    Points start = toy::straight(n, 0.2);
    Points x = start;
    for (int i = 0; i < x.size(); ++i) x.data()[i] += 0.05 * std::sin(7.0 * i + 1);
    const ImplicitStep step{0.3, 0.1, start};
    Points g, plus, minus;
    system.potential(step, x, g);
    EXPECT_EQ(g.row(0).norm(), 0.0);
    HessianBuilder builder(n, system.fixed());
    system.add_hessian(step, x, Curvature::kExact, builder);
    const Eigen::MatrixXd H = Eigen::MatrixXd(builder.build()).selfadjointView<Eigen::Lower>();
    const double e = 1e-5;  // central differences: the error is about 1e-9
    for (int i = 1; i < n; ++i)
        for (int k = 0; k < 3; ++k) {
            Points y = x;
            y(i, k) += e;
            const double up = system.potential(step, y, plus);
            y(i, k) -= 2 * e;
            const double down = system.potential(step, y, minus);
            EXPECT_NEAR(g(i, k), (up - down) / (2 * e), 1e-7);
            const Points difference = (plus - minus) / (2 * e);
            for (int j = 1; j < n; ++j)
                for (int m = 0; m < 3; ++m)
                    EXPECT_NEAR(H(3 * j + m, 3 * i + k), difference(j, m), 1e-6);
        }
}

TEST(MotionSystem, AllTermsAreToldOfTheStepAndAddTheirMetric) {
    auto one = std::make_shared<toy::Anchor>(1.0, 0.5),
         two = std::make_shared<toy::Anchor>(2.0, 0.0);
    MotionSystem system(Eigen::VectorXd::Ones(2), {});
    system.add(one);
    system.add(two);
    system.begin_step(0, 0.1, Points::Zero(2, 3), Points::Zero(2, 3));
    EXPECT_EQ(one->begun, 1);
    EXPECT_EQ(two->begun, 1);
    MetricBuilder metric(2);
    system.add_metric(0.1, metric);
    EXPECT_EQ(metric.build({}).coeff(1, 1), 1.0 + 5.0 + 2.0);
}

}  // namespace
}  // namespace risorius::solve
