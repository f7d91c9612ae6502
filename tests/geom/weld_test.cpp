// SPDX-License-Identifier: MIT
#include "risorius/geom/weld.h"

#include <gtest/gtest.h>

#include "geom/test_surfaces.h"
#include "risorius/geom/surface_topology.h"

namespace risorius::geom {
namespace {

/// Gives every triangle three vertices of its own, as in a file without shared vertices.
testing::Surface unrolled(const testing::Surface& surface) {
    testing::Surface out;
    out.positions.resize(surface.triangles.rows() * 3, 3);
    out.triangles.resize(surface.triangles.rows(), 3);
    for (int t = 0; t < surface.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) {
            out.positions.row(3 * t + k) = surface.positions.row(surface.triangles(t, k));
            out.triangles(t, k) = 3 * t + k;
        }
    return out;
}

TEST(Weld, TurnsASoupOfTrianglesBackIntoTheSurface) {
    const auto ball = testing::sphere(10, 14, 0.1);
    const auto soup = unrolled(ball);
    const WeldedSurface welded = weld(soup.positions, soup.triangles);
    EXPECT_EQ(welded.positions.rows(), ball.positions.rows());
    EXPECT_EQ(welded.triangles.rows(), ball.triangles.rows());
    EXPECT_EQ(welded.joined_count(), soup.positions.rows() - ball.positions.rows());
    EXPECT_TRUE(boundary_loops(welded.triangles, surface_edges(welded.triangles)).empty());
}

TEST(Weld, LeavesAMeshWithoutSeamsAlone) {
    const auto sheet = testing::square_grid(6);
    const WeldedSurface welded = weld(sheet.positions, sheet.triangles);
    EXPECT_EQ(welded.joined_count(), 0);
    EXPECT_TRUE(welded.positions == sheet.positions);
    EXPECT_TRUE(welded.triangles == sheet.triangles);
}

TEST(Weld, WeldingTwiceChangesNothingMore) {
    const auto soup = unrolled(testing::sphere(10, 14, 0.1));
    const WeldedSurface once = weld(soup.positions, soup.triangles);
    const WeldedSurface twice = weld(once.positions, once.triangles);
    EXPECT_EQ(twice.joined_count(), 0);
    EXPECT_TRUE(twice.triangles == once.triangles);
}

TEST(Weld, EveryVertexStaysWithinTheToleranceOfItsPlace) {
    auto soup = unrolled(testing::sphere(10, 14, 0.1));
    for (int v = 0; v < soup.positions.rows(); ++v)
        soup.positions(v, v % 3) += 4e-5 * ((v * 7) % 11 - 5) / 5.0;
    const double tolerance = 2e-4;
    const WeldedSurface welded = weld(soup.positions, soup.triangles, {.tolerance_m = tolerance});
    EXPECT_EQ(welded.positions.rows(), 2 + 9 * 14);
    for (int v = 0; v < soup.positions.rows(); ++v)
        EXPECT_LE((welded.positions.row(welded.welded_of_vertex[v]) - soup.positions.row(v)).norm(),
                  tolerance);
}

TEST(Weld, LipsThatTouchStayApart) {
    // Two sheets that touch everywhere, the second one flipped. Only their rims are boundaries.
    const auto sheet = testing::square_grid(4);
    Points p(50, 3);
    p << sheet.positions, sheet.positions;
    Triangles tri(64, 3);
    tri.topRows(32) = sheet.triangles;
    tri.bottomRows(32) = sheet.triangles.array() + 25;
    tri.bottomRows(32).col(1).swap(tri.bottomRows(32).col(2));
    const WeldedSurface welded = weld(p, tri);
    EXPECT_EQ(welded.joined_count(), 16);
    EXPECT_NE(welded.welded_of_vertex[12], welded.welded_of_vertex[37]);
    EXPECT_EQ(weld(p, tri, {.boundary_only = false}).joined_count(), 25);
}

TEST(Weld, UnusedVerticesAreLeftOutAndCollapsedTrianglesDropped) {
    Points p(6, 3);
    p << 9, 9, 9, 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1e-7, 0, 2, 0, 0;
    Triangles tri(2, 3);
    tri << 1, 2, 3, 2, 4, 5;
    const WeldedSurface welded = weld(p, tri);
    EXPECT_EQ(welded.welded_of_vertex, (std::vector<int>{-1, 0, 1, 2, 1, 3}));
    EXPECT_EQ(welded.first_vertex, (std::vector<int>{1, 2, 3, 5}));
    EXPECT_EQ(welded.source_triangle, (std::vector<int>{0}));
}

TEST(Weld, CoordinatesMayBeOfAnySize) {
    Points p(6, 3);
    p << 0, 0, 0, 1e90, 0, 0, 0, 1e90, 0, 0, 0, 0, 1e90, 0, 0, 0, -1e90, 0;
    Triangles tri(2, 3);
    tri << 0, 1, 2, 4, 3, 5;
    EXPECT_EQ(weld(p, tri).welded_of_vertex, (std::vector<int>{0, 1, 2, 0, 1, 3}));
}

TEST(Weld, VerticesAtEqualDistancesTakeNoLongerThanOthers) {
    // A prime number of cells apart: their places in a table of hashes were the same, and the work grew with the square of the number.
    constexpr int kVertices = 600000;
    Points p = Points::Zero(kVertices, 3);
    for (int v = 0; v < kVertices; ++v) p(v, 0) = 712697e-9 * v;
    Triangles tri(kVertices / 3, 3);
    for (int t = 0; t < kVertices / 3; ++t) tri.row(t) << 3 * t, 3 * t + 1, 3 * t + 2;
    EXPECT_EQ(weld(p, tri).positions.rows(), kVertices);
}

TEST(Weld, SpreadMovesBothSidesOfASeamTogether) {
    const auto soup = unrolled(testing::square_grid(3));
    const WeldedSurface welded = weld(soup.positions, soup.triangles);
    Points moved = welded.positions;
    moved.col(2).array() += 0.5 * moved.col(0).array();
    Points out = soup.positions;
    spread(welded, moved, out);
    for (int v = 0; v < out.rows(); ++v) EXPECT_EQ(out(v, 2), 0.5 * out(v, 0));
}

}  // namespace
}  // namespace risorius::geom
