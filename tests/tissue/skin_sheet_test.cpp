// SPDX-License-Identifier: MIT
#include "risorius/tissue/skin_sheet.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "tissue/layered_block.h"

namespace risorius::tissue {
namespace {

SkinSheet sheet_over(const LayeredBlock& block, double membrane_n_per_m, double bending_n_m) {
    const auto count = block.top.rows();
    return SkinSheet(block.top, block.rest, Eigen::VectorXd::Constant(count, membrane_n_per_m),
                     Eigen::VectorXd::Constant(count, bending_n_m));
}

/// A strip of two triangles that is folded along the y axis by `angle`, with hinge edge 0-1.
Points folded(double angle) {
    Points x(4, 3);
    x << 0, 0, 0, 0, 5e-3, 0, 4e-3 * std::cos(angle), 2e-3, 4e-3 * std::sin(angle), -4e-3, 3e-3, 0;
    return x;
}

SkinSheet one_hinge(const Points& rest, double bending_n_m) {
    Triangles triangles(2, 3);
    triangles << 0, 2, 1, 0, 1, 3;
    return SkinSheet(triangles, rest, Eigen::VectorXd::Zero(2),
                     Eigen::VectorXd::Constant(2, bending_n_m));
}

// 6 x 5 nodes: 40 triangles and 51 hinges, which do not fill the last lanes.
const LayeredBlock kThinBlock(6, 5, 1);

TEST(SkinSheet, EveryInnerEdgeBends) {
    const SkinSheet sheet = sheet_over(kThinBlock, 20, 2e-5);
    EXPECT_EQ(sheet.triangle_count(), 40);
    EXPECT_EQ(sheet.hinge_count(), 51);  // 20 diagonals, 15 + 16 inner edges
}

TEST(SkinSheet, RestIsFreeOfStress) {
    Points gradient = Points::Zero(kThinBlock.nodes(), 3);
    EXPECT_LT(std::abs(sheet_over(kThinBlock, 20, 2e-5).add_energy(kThinBlock.rest, gradient)),
              1e-30);
    EXPECT_LT(gradient.cwiseAbs().maxCoeff(), 1e-15);
}

TEST(SkinSheet, FloatForcesAreThoseOfDoubleToAMillionthAndRestIsExact) {
    const SkinSheet sheet = sheet_over(kThinBlock, 20, 2e-5);
    const Points x = shaken(kThinBlock.rest, 1e-3, 9);
    Points exact = Points::Zero(kThinBlock.nodes(), 3), single = exact, at_rest = exact;
    const double energy = sheet.add_energy(x, exact);
    EXPECT_NEAR(sheet.add_energy(x, single, solve::Precision::kSingle), energy, 2e-6 * energy);
    EXPECT_LT((single - exact).norm(), 2e-6 * exact.norm());
    EXPECT_GT((single - exact).norm(), 0.0);
    EXPECT_EQ(sheet.add_energy(kThinBlock.rest, at_rest, solve::Precision::kSingle), 0.0);
    EXPECT_TRUE(at_rest.isZero(0.0));
}

TEST(SkinSheet, MembraneForcesAreTheSlopeOfTheEnergy) {
    expect_gradient_is_exact(sheet_over(kThinBlock, 20, 0), shaken(kThinBlock.rest, 1e-3, 1));
}

TEST(SkinSheet, BendingForcesAreTheSlopeOfTheEnergy) {
    expect_gradient_is_exact(sheet_over(kThinBlock, 0, 2e-5), shaken(kThinBlock.rest, 1e-3, 2));
}

TEST(SkinSheet, AFlatHingeAtRestIsSmooth) {
    const Points rest = folded(0.0);
    const SkinSheet hinge = one_hinge(rest, 2e-5);
    Points gradient = Points::Zero(4, 3);
    EXPECT_LT(hinge.add_energy(rest, gradient), 1e-30);
    EXPECT_LT(gradient.cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_TRUE(gradient.allFinite());
    expect_gradient_is_exact(hinge, shaken(rest, 1e-6, 3), 1e-5);
    // Linear from the start: half the fold gives half the force. Up and down make no difference.
    const double whole = gradient_of(hinge, folded(2e-4)).norm();
    EXPECT_NEAR(gradient_of(hinge, folded(1e-4)).norm() / whole, 0.5, 1e-3);
    EXPECT_NEAR(gradient_of(hinge, folded(-2e-4)).norm() / whole, 1.0, 1e-3);
}

TEST(SkinSheet, AFoldedHingeFlattenedKeepsFiniteForces) {
    const SkinSheet hinge = one_hinge(folded(0.4), 2e-5);
    const Points gradient = gradient_of(hinge, folded(0.0));
    EXPECT_TRUE(gradient.allFinite());
    expect_gradient_is_exact(hinge, shaken(folded(0.0), 2e-5, 4), 1e-5);
}

TEST(SkinSheet, RollingAStripCostsTheSumOfItsFolds) {
    // Rolled along x, only the edges across the strip fold, each by spacing / radius: w/2 (|e| angle)^2 with w = 3 kB /
    // (spacing |e|). Summed over the n - 2 inner lines of edges, this is 3 kB/2 area / radius^2 (n - 2)/(n - 1).
    const int n = 41;
    LayeredBlock block(n, 5, 1, 1e-3);
    block.rest.col(2).setZero();
    const double kb = 2e-5, radius = 0.2;
    const SkinSheet sheet = sheet_over(block, 0, kb);
    Points rolled = block.rest, gradient = Points::Zero(block.nodes(), 3);
    for (Eigen::Index i = 0; i < rolled.rows(); ++i) {
        const double angle = block.rest(i, 0) / radius;
        rolled(i, 0) = radius * std::sin(angle);
        rolled(i, 2) = radius * (1 - std::cos(angle));
    }
    const double expected = 1.5 * kb * (40e-3 * 4e-3) / (radius * radius) * 39 / 40;
    // For angles of 1/200, the error of the small-angle form is of the order of their square.
    EXPECT_NEAR(sheet.add_energy(rolled, gradient), expected, 1e-4 * expected);
}

TEST(SkinSheet, RigidMotionCostsNothing) {
    Points gradient = Points::Zero(kThinBlock.nodes(), 3);
    const Points x = moved(kThinBlock.rest, some_motion());
    EXPECT_LT(std::abs(sheet_over(kThinBlock, 20, 2e-5).add_energy(x, gradient)), 1e-28);
    EXPECT_LT(gradient.cwiseAbs().maxCoeff(), 1e-14);
}

TEST(SkinSheet, InternalForcesAddUpToNothing) {
    const Points x = shaken(kThinBlock.rest, 1e-3, 5);
    expect_no_net_force_or_torque(x, gradient_of(sheet_over(kThinBlock, 20, 2e-5), x));
}

TEST(SkinSheet, TheMetricBoundsTheStiffnessAtRest) {
    const SkinSheet sheet = sheet_over(kThinBlock, 20, 2e-5);
    solve::MetricBuilder builder(kThinBlock.nodes());
    sheet.add_metric(builder);
    const Eigen::MatrixXd lower = builder.build({});
    const Eigen::MatrixXd metric = lower.selfadjointView<Eigen::Lower>();
    const Points u = shaken(Points::Zero(kThinBlock.nodes(), 3), 1e-9, 6);
    const Points gradient = gradient_of(sheet, kThinBlock.rest + u);
    const double stored = 0.5 * (u.array() * gradient.array()).sum();
    const double bound = 0.5 * (u.array() * (metric * u).array()).sum();
    EXPECT_GT(stored, 0.05 * bound);
    EXPECT_LE(stored, bound * 1.0001);
}

TEST(SkinSheet, TwoRunsGiveTheSameBits) {
    const SkinSheet a = sheet_over(kThinBlock, 20, 2e-5), b = sheet_over(kThinBlock, 20, 2e-5);
    const Points x = shaken(kThinBlock.rest, 1e-3, 7);
    EXPECT_TRUE((gradient_of(a, x).array() == gradient_of(b, x).array()).all());
}

TEST(SkinSheet, ATriangleWithoutAreaIsRefused) {
    Points rest(3, 3);
    rest << 0, 0, 0, 1, 0, 0, 2, 0, 0;
    Triangles triangles(1, 3);
    triangles << 0, 1, 2;
    const Eigen::VectorXd one = Eigen::VectorXd::Ones(1);
    try {
        SkinSheet(triangles, rest, one, one);
        FAIL() << "accepted";
    } catch (const std::invalid_argument& error) {
        EXPECT_STREQ(error.what(), "SkinSheet: triangle 0 has no area at rest");
    }
}

}  // namespace
}  // namespace risorius::tissue
