// SPDX-License-Identifier: MIT
#include "risorius/tissue/grid_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "risorius/core/dense_algebra.h"
#include "risorius/core/error.h"
#include "tissue/term_checks.h"

namespace risorius::tissue {
namespace {

using namespace laws;

GridCurve varied_curve() {
    GridCurve curve;
    curve.rest = line_rest(7, Vec3(0.1, 0, 0), Vec3(1.0, 0.4, -0.3));
    for (int i = 0; i < 7; ++i) curve.material.push_back({20.0 + i, 0.5, 0.3 + 0.1 * i, 1, 0});
    return curve;
}

/// A section of a helix, unevenly spaced.
GridCurve bent_curve() {
    GridCurve curve = varied_curve();
    for (int i = 0; i < 7; ++i) {
        const double angle = 0.4 * i + 0.02 * i * i;
        curve.rest.row(i) << std::cos(angle), std::sin(angle), 0.2 * angle;
    }
    return curve;
}

class AnyGridCurve : public testing::TestWithParam<GridCurve (*)()> {
  protected:
    GridCurve curve = GetParam()();
    GridCurveTerm term{curve};
    Points shape = shaken(curve.rest, 0.1, 1);
};

TEST_P(AnyGridCurve, PassesItsChecks) { EXPECT_NO_THROW(check(curve, "curve")); }
TEST_P(AnyGridCurve, ForceIsTheSlopeOfTheEnergy) { expect_force_is_exact(term, shape); }
TEST_P(AnyGridCurve, PotentialAndItsDerivativesAgree) {
    expect_potential_is_exact(term, curve.rest, shape, 0.02);
}
TEST_P(AnyGridCurve, PositiveCurvatureIsPositive) {
    expect_positive_curvature(term, curve.rest, 0.5 * shape, 0.02);
}
TEST_P(AnyGridCurve, RestIsFreeOfForceHoweverTurned) { expect_rest_is_free(term, curve.rest); }
TEST_P(AnyGridCurve, InternalForcesAddUpToNothing) {
    expect_no_net_force_or_torque(shape, force_of(term, shape));
}
TEST_P(AnyGridCurve, DampingTakesEnergyOut) { expect_damping_dissipates(term, shape); }
TEST_P(AnyGridCurve, SecantIsTheForce) { expect_secant_is_the_force(term, shape); }
TEST_P(AnyGridCurve, MetricBoundsTheStiffnessAtRest) {
    expect_metric_bounds_rest(term, curve.rest, 0.02, 2.0);
}

std::string name_of_curve(const testing::TestParamInfo<GridCurve (*)()>& which) {
    return which.index == 0 ? "Straight" : "Bent";
}
INSTANTIATE_TEST_SUITE_P(Rest, AnyGridCurve, testing::Values(&varied_curve, &bent_curve),
                         name_of_curve);

TEST(GridCurve, ABentCurvePulledStraightHasFiniteForces) {
    const GridCurve curve = bent_curve();
    const GridCurveTerm term(curve);
    const Points straight = line_rest(7, Vec3(0, 0, 0), Vec3(2, 0, 0));
    EXPECT_TRUE(force_of(term, straight).allFinite());
    expect_force_is_exact(term, shaken(straight, 1e-3, 2), 1e-6);
}

/// Both of the first two nodes are held and a small load acts on the other end. Deflection divided by P L^3 / (3 EI).
TEST(GridCurve, ACantileverBendsAsABeamShorterByHalfALink) {
    const double length = 2, stiffness = 0.7, load_n = 1e-4;
    for (const int nodes : {9, 17, 33}) {
        GridCurve curve;
        curve.rest = line_rest(nodes, Vec3::Zero(), Vec3(length, 0, 0));
        curve.material = {rod_material(1e4, stiffness, length)};
        std::vector<char> fixed(static_cast<std::size_t>(nodes), 0);
        fixed[0] = fixed[1] = 1;
        Points load = Points::Zero(nodes, 3);
        load(nodes - 1, 1) = load_n;
        const Points u = small_deflection(GridCurveTerm(curve), curve.rest, fixed, load);
        const double h = 1.0 / (nodes - 1);
        const double beam = load_n * std::pow(length * (1 - h / 2), 3) / (3 * stiffness);
        EXPECT_NEAR(u(nodes - 1, 1), beam, h * h * beam) << nodes;
    }
}

TEST(GridCurve, BucklesAtEulersLoad) {
    // Pinned at both ends and compressed by P: the force of a link is EA/2 (s^3 - s). Bending is measured in material
    // coordinates, so a rod that is compressed to s times its length buckles at s EI (q / L)^2, where q = 2/h sin(pi h / 2) is
    // the discrete pi.
    const int nodes = 21;
    const double length = 1.5, bending = 0.4, tension = 500;
    const double h = 1.0 / (nodes - 1);
    const double q = 2 / h * std::sin(std::numbers::pi * h / 2);
    const double euler = bending * q * q / (length * length);
    GridCurve curve;
    curve.rest = line_rest(nodes, Vec3::Zero(), Vec3(length, 0, 0));
    curve.material = {rod_material(tension, bending, length)};
    const GridCurveTerm term(curve);
    std::vector<char> fixed(static_cast<std::size_t>(nodes), 0);
    fixed.front() = fixed.back() = 1;
    for (const double fraction : {0.995, 1.005}) {
        double s = 1;
        for (int k = 0; k < 30; ++k)
            s -= (0.5 * tension * (s * s - 1) + fraction * euler) / (tension * s);
        const Points pressed = s * curve.rest;
        solve::HessianBuilder builder(nodes, fixed);
        term.add_hessian(no_motion(pressed), pressed, solve::Curvature::kExact, builder);
        const Eigen::MatrixXd lower = builder.build();
        const double min = symmetric_eigenvalues(lower)[0];
        EXPECT_EQ(min > 0, fraction < 1) << min;
    }
}

TEST(GridCurve, HangsAsACatenary) {
    // Between two points at the same height: length = 2 a sinh(span / 2a), sag = a (cosh(span / 2a) - 1).
    const double length = 1, span = 0.6, weight = 9.81;
    double a = span / 4;
    for (int k = 0; k < 100; ++k) {
        const double u = span / (2 * a);
        a -= (2 * a * std::sinh(u) - length) / (2 * std::sinh(u) - 2 * u * std::cosh(u));
    }
    const double expected = a * (std::cosh(span / (2 * a)) - 1);
    double error_before = 0;
    for (const int nodes : {11, 21, 41}) {
        GridCurve curve;
        curve.rest = line_rest(nodes, Vec3::Zero(), Vec3(length, 0, 0));
        curve.material = {rod_material(1e6, 0, length)};
        std::vector<char> fixed(static_cast<std::size_t>(nodes), 0);
        fixed.front() = fixed.back() = 1;
        Points load = Points::Zero(nodes, 3), x = curve.rest;
        // Half of a link's weight is on each of its ends, because the weight of a catenary is distributed over its length.
        load.col(2).setConstant(-weight / (nodes - 1));
        for (int i = 0; i < nodes; ++i) {
            const double along = 2.0 * i / (nodes - 1) - 1;
            x.row(i) << 0.5 * span * (1 + along), 0, -0.4 * (1 - along * along);
        }
        ASSERT_TRUE(solve(GridCurveTerm(curve), fixed, load, x)) << nodes;
        const double error = std::abs(-x(nodes / 2, 2) - expected) / expected;
        const double h = 1.0 / (nodes - 1);
        EXPECT_LT(error, 1.0 * h * h) << nodes;
        if (error_before > 0) {
            EXPECT_NEAR(error_before / error, 4.0, 0.8) << nodes;
        }
        error_before = error;
    }
}

std::string message_of(const GridCurve& curve) {
    try {
        check(curve, "rope.json:/body");
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(GridCurve, WhatIsWrongIsNamed) {
    GridCurve curve = varied_curve();
    curve.rest.conservativeResize(1, 3);
    EXPECT_EQ(message_of(curve), "rope.json:/body/rest: expected at least 2 nodes, found 1");
    curve = varied_curve();
    curve.rest(2, 0) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(message_of(curve),
              "rope.json:/body/rest/2: expected three finite numbers, found [nan, 0.133333, -0.1]");
    curve = varied_curve();
    curve.rest.row(3) = curve.rest.row(2);
    EXPECT_EQ(message_of(curve),
              "rope.json:/body/rest/3: expected a place of its own, found that of the node before");
    curve = varied_curve();
    curve.rest.row(3) = curve.rest.row(1);
    EXPECT_EQ(
        message_of(curve),
        "rope.json:/body/rest/3: expected a shape without folds, found a link turning back on "
        "the one before");
    curve = varied_curve();
    curve.material.resize(3);
    EXPECT_EQ(message_of(curve),
              "rope.json:/body/material: expected 1 material or 7, one per node, found 3");
    curve = varied_curve();
    curve.material[4].mass_kg = -4;
    EXPECT_EQ(message_of(curve), "rope.json:/body/material/4/mass_kg: expected (0, inf), found -4");
    curve.material = {{.bending_n_per_m = -1}};
    EXPECT_EQ(message_of(curve),
              "rope.json:/body/material/bending_n_per_m: expected [0, inf), found -1");
}

}  // namespace
}  // namespace risorius::tissue
