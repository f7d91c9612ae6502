// SPDX-License-Identifier: MIT
#include "risorius/geom/closest_point.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "geom/test_surfaces.h"

namespace risorius::geom {
namespace {

/// Random numbers with the same bits everywhere. The distributions of <random> differ between libraries.
class Dice {
  public:
    double operator()() { return static_cast<double>(engine_()) / 4294967296.0; }
    Vec3 in_box(double half) {
        const double x = (*this)(), y = (*this)(), z = (*this)();
        return half * (2 * Vec3(x, y, z) - Vec3::Ones());
    }

  private:
    std::mt19937 engine_{20};
};

TEST(ClosestPointOnTriangle, BeatsEveryPointOfADenseSampling) {
    Dice dice;
    for (int trial = 0; trial < 300; ++trial) {
        const Vec3 a = dice.in_box(1), b = dice.in_box(1), c = dice.in_box(1), p = dice.in_box(2);
        const TrianglePoint found = closest_point_on_triangle(p, a, b, c);
        EXPECT_NEAR(found.barycentric.sum(), 1.0, 1e-12);
        EXPECT_GE(found.barycentric.minCoeff(), 0.0);
        EXPECT_NEAR((found.point - p).squaredNorm(), found.squared_distance, 1e-12);
        double sampled = 1e300;
        const int n = 60;
        for (int i = 0; i <= n; ++i)
            for (int j = 0; i + j <= n; ++j) {
                const double u = i / double(n), v = j / double(n);
                sampled = std::min(sampled, (p - ((1 - u - v) * a + u * b + v * c)).norm());
            }
        const double distance = std::sqrt(found.squared_distance);
        EXPECT_LE(distance, sampled + 1e-12);
        EXPECT_GE(distance,
                  sampled - 3.5 / n);  // one sampling step: sides are at most 2 sqrt 3 long
    }
}

TEST(ClosestPointOnTriangle, TreatsACollapsedTriangleAsItsLongestSide) {
    const Vec3 a(0, 0, 0), b(1, 0, 0), c(0.3, 0, 0);
    const TrianglePoint found = closest_point_on_triangle(Vec3(0.7, 2, 0), a, b, c);
    EXPECT_NEAR(found.squared_distance, 4.0, 1e-15);
    const TrianglePoint at_point = closest_point_on_triangle(Vec3(3, 4, 0), a, a, a);
    EXPECT_EQ(at_point.squared_distance, 25.0);
    EXPECT_EQ(at_point.barycentric.sum(), 1.0);
}

TEST(SurfaceTree, FindsTheSameTriangleAsLookingAtAllOfThem) {
    auto ball = testing::sphere(20, 30, 0.1);
    Dice dice;
    for (int v = 0; v < ball.positions.rows(); ++v)
        ball.positions.row(v) += dice.in_box(0.005).transpose();
    const SurfaceTree tree(ball.positions, ball.triangles);
    for (int trial = 0; trial < 2000; ++trial) {
        const Vec3 p = dice.in_box(0.2);
        int best = -1;
        double best_d2 = 1e300;
        for (int t = 0; t < ball.triangles.rows(); ++t) {
            const auto at = [&](int k) {
                return Vec3(ball.positions.row(ball.triangles(t, k)).transpose());
            };
            const double d2 = closest_point_on_triangle(p, at(0), at(1), at(2)).squared_distance;
            if (d2 < best_d2) best = t, best_d2 = d2;
        }
        const auto found = tree.closest(p);
        ASSERT_TRUE(found);
        EXPECT_EQ(found->squared_distance, best_d2);
        EXPECT_EQ(found->triangle, best);
    }
}

TEST(SurfaceTree, GivesTheLowestTriangleOfEquallyNearOnes) {
    const auto sheet = testing::square_grid(8);
    const SurfaceTree tree(sheet.positions, sheet.triangles);
    // Directly above vertex 40, where six triangles meet.
    const Vec3 corner = sheet.positions.row(40).transpose();
    int lowest = -1;
    for (int t = 0; t < sheet.triangles.rows() && lowest < 0; ++t)
        for (int k = 0; k < 3; ++k)
            if (sheet.triangles(t, k) == 40) lowest = t;
    EXPECT_EQ(tree.closest(corner + Vec3(0, 0, 0.5))->triangle, lowest);
    EXPECT_EQ(tree.cast(corner + Vec3(0, 0, 0.5), Vec3(0, 0, -1))->triangle, lowest);
}

TEST(SurfaceTree, SeesNothingBeyondTheGivenDistance) {
    const auto sheet = testing::square_grid(2);
    const SurfaceTree tree(sheet.positions, sheet.triangles);
    EXPECT_FALSE(tree.closest(Vec3(0.5, 0.5, 0.2), 0.19));
    EXPECT_TRUE(tree.closest(Vec3(0.5, 0.5, 0.2), 0.2));
    EXPECT_FALSE(tree.cast(Vec3(0.5, 0.5, 1.0), Vec3(0, 0, -1), 0.9));
    EXPECT_FALSE(SurfaceTree().closest(Vec3::Zero()));
    EXPECT_FALSE(SurfaceTree(Points(), Triangles()).cast(Vec3::Zero(), Vec3::UnitX()));
}

TEST(SurfaceTree, MeetsRaysWhereLookingAtAllTrianglesDoes) {
    auto ball = testing::sphere(16, 24, 0.1);
    Dice dice;
    for (int v = 0; v < ball.positions.rows(); ++v)
        ball.positions.row(v) += dice.in_box(0.02).transpose();
    const SurfaceTree tree(ball.positions, ball.triangles);
    int hits = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        const Vec3 origin = dice.in_box(0.3), direction = dice.in_box(1.0);
        // Each triangle is tested separately, through a tree of one.
        double nearest = 1e300;
        for (int t = 0; t < ball.triangles.rows(); ++t) {
            const Triangles one = ball.triangles.row(t);
            if (const auto hit = SurfaceTree(ball.positions, one).cast(origin, direction))
                nearest = std::min(nearest, hit->distance);
        }
        const auto found = tree.cast(origin, direction);
        ASSERT_EQ(found.has_value(), nearest < 1e300);
        if (!found) continue;
        ++hits;
        EXPECT_EQ(found->distance, nearest);
        const auto at = [&](int k) {
            return Vec3(ball.positions.row(ball.triangles(found->triangle, k)).transpose());
        };
        const Vec3& w = found->barycentric;
        EXPECT_LT((w(0) * at(0) + w(1) * at(1) + w(2) * at(2) - found->point).norm(), 1e-12);
    }
    EXPECT_GT(hits, 100);
}

TEST(SurfaceTree, EveryRayFromInsideAClosedBallLeavesThroughIt) {
    const auto ball = testing::sphere(12, 18, 1.0);
    const SurfaceTree tree(ball.positions, ball.triangles);
    // Rays go straight at every vertex and every midpoint of an edge, where gaps would show.
    for (int v = 0; v < ball.positions.rows(); ++v)
        EXPECT_TRUE(tree.cast(Vec3::Zero(), ball.positions.row(v).transpose())) << "vertex " << v;
    for (int t = 0; t < ball.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) {
            const Vec3 middle = ball.positions.row(ball.triangles(t, k)).transpose() +
                                ball.positions.row(ball.triangles(t, (k + 1) % 3)).transpose();
            EXPECT_TRUE(tree.cast(Vec3::Zero(), middle)) << "triangle " << t << ", side " << k;
        }
}

TEST(SurfaceTree, RefittedAnswersAsOneBuiltAnew) {
    auto ball = testing::sphere(16, 24, 0.1);
    SurfaceTree tree(ball.positions, ball.triangles);
    Dice dice;
    for (int v = 0; v < ball.positions.rows(); ++v)
        ball.positions.row(v) += dice.in_box(0.03).transpose();
    tree.refit(ball.positions);
    const SurfaceTree fresh(ball.positions, ball.triangles);
    for (int trial = 0; trial < 500; ++trial) {
        const Vec3 p = dice.in_box(0.2);
        EXPECT_EQ(tree.closest(p)->triangle, fresh.closest(p)->triangle);
        EXPECT_EQ(tree.closest(p)->point, fresh.closest(p)->point);
    }
}

TEST(SurfaceBinding, HoldsThePointAtRestAndFollowsARigidMotion) {
    const auto ball = testing::sphere(16, 24, 0.1);
    const SurfaceTree tree(ball.positions, ball.triangles);
    Dice dice;
    Points points(200, 3);
    for (int i = 0; i < 200; ++i) points.row(i) = dice.in_box(0.15).transpose();
    const auto bindings = bind_to_surface(points, tree, ball.positions, ball.triangles);
    Rigid motion = Rigid::Identity();
    motion.rotate(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()))
        .pretranslate(Vec3(0.1, -0.2, 0.3));
    Points moved = ball.positions;
    for (int v = 0; v < moved.rows(); ++v)
        moved.row(v) = (motion * Vec3(ball.positions.row(v).transpose())).transpose();
    for (int i = 0; i < 200; ++i) {
        const Vec3 p = points.row(i).transpose();
        EXPECT_LT((bound_point(bindings[i], ball.positions, ball.triangles) - p).norm(), 1e-15);
        EXPECT_LT((bound_point(bindings[i], moved, ball.triangles) - motion * p).norm(), 1e-14);
    }
}

TEST(SurfaceBinding, APointAboveAStretchedSheetKeepsItsHeight) {
    const auto sheet = testing::square_grid(4);
    const SurfaceTree tree(sheet.positions, sheet.triangles);
    Points above(1, 3);
    above << 0.33, 0.61, 0.02;
    const auto bindings = bind_to_surface(above, tree, sheet.positions, sheet.triangles);
    Points stretched = sheet.positions;
    stretched.col(0) *= 2.0;
    const Vec3 now = bound_point(bindings[0], stretched, sheet.triangles);
    EXPECT_LT((now - Vec3(0.66, 0.61, 0.02)).norm(), 1e-15);
}

}  // namespace
}  // namespace risorius::geom
