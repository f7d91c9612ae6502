// SPDX-License-Identifier: MIT
// The score of an expression, on fields whose score is known exactly.
#include "risorius/scene/expression_score.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace risorius::scene {
namespace {

Points field(const Vec3& a, const Vec3& b) {
    Points out(2, 3);
    out.row(0) = a.transpose();
    out.row(1) = b.transpose();
    return out;
}
const Eigen::VectorXd kEven = Eigen::VectorXd::Ones(2);

TEST(ExpressionScore, OfTheSameFieldIsPerfect) {
    const Points g = field({0.001, 0, 0.002}, {0, -0.003, 0});
    const ExpressionScore s = score(g, g, kEven, {0, 1});
    EXPECT_NEAR(s.cosine, 1, 1e-15);
    EXPECT_EQ(s.relative, 0);
    EXPECT_EQ(s.rms_m, 0);
    EXPECT_EQ(s.max_m, 0);
    EXPECT_EQ(s.landmark_m, 0);
    EXPECT_DOUBLE_EQ(s.peak_m, 0.003);
}

TEST(ExpressionScore, OfAFaceThatDoesNotMoveIsOne) {
    const ExpressionScore s =
        score(field({0, 0, 0}, {0, 0, 0}), field({0.003, 0, 0}, {0, 0.004, 0}), kEven, {1});
    EXPECT_EQ(s.cosine, 0);
    EXPECT_DOUBLE_EQ(s.relative, 1);
    EXPECT_NEAR(s.rms_m, 0.005 / std::sqrt(2.0), 1e-15);
    EXPECT_DOUBLE_EQ(s.max_m, 0.004);
    EXPECT_DOUBLE_EQ(s.landmark_m, 0.004);
    EXPECT_EQ(s.simulated_peak_m, 0);
}

TEST(ExpressionScore, CosineDoesNotSeeStrengthAndRelativeErrorDoes) {
    const Points g = field({0.002, 0, 0}, {0, 0.002, 0});
    const ExpressionScore half = score(0.5 * g, g, kEven, {});
    EXPECT_NEAR(half.cosine, 1, 1e-15);
    EXPECT_NEAR(half.relative, 0.5, 1e-15);
    const ExpressionScore opposite = score(-g, g, kEven, {});
    EXPECT_NEAR(opposite.cosine, -1, 1e-15);
    EXPECT_NEAR(opposite.relative, 2, 1e-15);
}

TEST(ExpressionScore, AtRightAnglesIsNotAlikeAtAll) {
    const ExpressionScore s =
        score(field({0, 0.001, 0}, {0, 0, 0}), field({0.001, 0, 0}, {0, 0, 0}), kEven, {});
    EXPECT_EQ(s.cosine, 0);
    EXPECT_NEAR(s.relative, std::sqrt(2.0), 1e-15);
}

TEST(ExpressionScore, VerticesCountByTheirArea) {
    // A vertex of no area is not there; three times the area counts as three vertices
    const Points u = field({0.001, 0, 0}, {5, 5, 5}), g = field({0.002, 0, 0}, {0, 0, 0});
    EXPECT_NEAR(score(u, g, Eigen::Vector2d(1, 0), {}).relative, 0.5, 1e-15);
    EXPECT_EQ(score(u, g, Eigen::Vector2d(1, 0), {}).max_m, 0.001);
    const Points v = field({0.001, 0, 0}, {0, 0, 0}), h = field({0, 0, 0}, {0.001, 0, 0});
    EXPECT_NEAR(score(v, h, Eigen::Vector2d(3, 1), {}).relative, std::sqrt(4.0), 1e-12);
}

TEST(ExpressionScore, RmsOfWhatMovesLeavesOutWhatIsStill) {
    const Points u = field({0.001, 0, 0}, {0, 0, 0}), g = field({0.003, 0, 0}, {0.0004, 0, 0});
    const ExpressionScore s = score(u, g, kEven, {});
    EXPECT_NEAR(s.rms_moved_m, 0.002, 1e-15);
    EXPECT_LT(s.rms_m, 0.002);
}

TEST(ExpressionScore, AreasOfVerticesSumUpToTheSurface) {
    Points square(4, 3);
    square << 0, 0, 0, 2, 0, 0, 2, 3, 0, 0, 3, 0;
    Triangles triangles(2, 3);
    triangles << 0, 1, 2, 0, 2, 3;
    const Eigen::VectorXd area = vertex_areas(triangles, square);
    EXPECT_NEAR(area.sum(), 6, 1e-12);
    EXPECT_NEAR(area[0], 2, 1e-12);  // a third of both
    EXPECT_NEAR(area[1], 1, 1e-12);
}

TEST(ExpressionScore, IsWrittenInMillimetres) {
    ExpressionScore s;
    s.rms_m = 0.0012;
    s.landmark_m = 0.002;
    EXPECT_DOUBLE_EQ(s.json()["rms_mm"].get<double>(), 1.2);
    EXPECT_DOUBLE_EQ(s.json()["landmark_mm"].get<double>(), 2);
}

}  // namespace
}  // namespace risorius::scene
