// SPDX-License-Identifier: MIT
#include "risorius/geom/surface_topology.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "geom/test_surfaces.h"

namespace risorius::geom {
namespace {

using testing::sphere;
using testing::square_grid;

TEST(SurfaceTopology, EulerCountsASphereAsTwoAndASheetAsOne) {
    const auto ball = sphere(8, 12, 1.0);
    EXPECT_EQ(ball.positions.rows() - surface_edges(ball.triangles).count() + ball.triangles.rows(),
              2);
    const auto sheet = square_grid(7);
    EXPECT_EQ(
        sheet.positions.rows() - surface_edges(sheet.triangles).count() + sheet.triangles.rows(),
        1);
}

TEST(SurfaceTopology, NeighboursAreMutualAndShareTheSide) {
    const auto sheet = square_grid(5);
    const Triangles& tri = sheet.triangles;
    const Triangles across = triangle_neighbours(surface_edges(tri), static_cast<int>(tri.rows()));
    int boundary_sides = 0;
    for (int t = 0; t < tri.rows(); ++t)
        for (int k = 0; k < 3; ++k) {
            const int other = across(t, k);
            if (other < 0) {
                ++boundary_sides;
                continue;
            }
            bool mutual = false;
            for (int j = 0; j < 3; ++j)
                mutual |= across(other, j) == t && tri(other, j) == tri(t, (k + 1) % 3) &&
                          tri(other, (j + 1) % 3) == tri(t, k);
            EXPECT_TRUE(mutual) << "triangle " << t << ", side " << k;
        }
    EXPECT_EQ(boundary_sides, 4 * 5);
}

TEST(SurfaceTopology, AClosedSurfaceHasNoBoundaryAndASheetHasOneAroundIt) {
    const auto ball = sphere(6, 9, 1.0);
    EXPECT_TRUE(boundary_loops(ball.triangles, surface_edges(ball.triangles)).empty());
    const auto sheet = square_grid(3);
    const auto loops = boundary_loops(sheet.triangles, surface_edges(sheet.triangles));
    ASSERT_EQ(loops.size(), 1u);
    // Counter-clockwise, as the triangles are.
    EXPECT_EQ(loops[0], (std::vector<int>{0, 1, 2, 3, 7, 11, 15, 14, 13, 12, 8, 4}));
}

TEST(SurfaceTopology, TwoHolesTouchingInAVertexAreTwoLoops) {
    // A 4 x 4 sheet without two cells that meet at vertex 12, in the middle.
    const auto sheet = square_grid(4);
    Triangles kept(sheet.triangles.rows() - 4, 3);
    long n = 0;
    for (int t = 0; t < sheet.triangles.rows(); ++t)
        if (const int cell = t / 2; cell != 5 && cell != 10) kept.row(n++) = sheet.triangles.row(t);
    const auto loops = boundary_loops(kept, surface_edges(kept));
    ASSERT_EQ(loops.size(), 3u);
    EXPECT_EQ(loops[0].size(), 16u);
    EXPECT_EQ(loops[1], (std::vector<int>{6, 11, 12, 7}));
    EXPECT_EQ(loops[2], (std::vector<int>{12, 17, 18, 13}));
}

TEST(SurfaceTopology, ALongBoundaryIsWalkedOnce) {
    // A fan: each of its vertices lies on the boundary. Searching the whole chain at each step would take an hour.
    constexpr int kCount = 1000000;
    Triangles fan(kCount - 2, 3);
    for (int t = 0; t < fan.rows(); ++t) fan.row(t) << 0, t + 1, t + 2;
    const auto loops = boundary_loops(fan, surface_edges(fan));
    ASSERT_EQ(loops.size(), 1u);
    ASSERT_EQ(loops[0].size(), static_cast<std::size_t>(kCount));
    for (int v = 0; v < kCount; ++v) ASSERT_EQ(loops[0][v], v);
}

TEST(SurfaceTopology, PiecesAreCountedAndNumberedByTheirFirstTriangle) {
    Triangles tri(4, 3);
    tri << 6, 7, 8, 0, 1, 2, 2, 3, 4, 8, 9, 6;
    const SurfacePieces pieces = surface_pieces(tri, 11);
    EXPECT_EQ(pieces.count(), 2);
    EXPECT_EQ(pieces.of_triangle, (std::vector<int>{0, 1, 1, 0}));
    EXPECT_EQ(pieces.triangle_count, (std::vector<int>{2, 2}));
    EXPECT_EQ(pieces.of_vertex[5], -1);
    EXPECT_EQ(pieces.of_vertex[9], 0);
    EXPECT_EQ(pieces.of_vertex[4], 1);
}

TEST(SurfaceTopology, EveryInnerEdgeIsOneHingeAndAFlippedTriangleHasNone) {
    const auto ball = sphere(6, 9, 1.0);
    const SurfaceEdges edges = surface_edges(ball.triangles);
    const auto hinges = surface_hinges(ball.triangles, edges);
    EXPECT_EQ(static_cast<int>(hinges.size()), edges.count());
    for (const Hinge& h : hinges) {
        // Seen from outside, the first wing is left of the edge and the second right of it.
        const Vec3 a = ball.positions.row(h.edge[0]), b = ball.positions.row(h.edge[1]);
        const Vec3 left = (a + b).cross(b - a);
        EXPECT_GT(left.dot(Vec3(ball.positions.row(h.wing[0])) - a), 0);
        EXPECT_LT(left.dot(Vec3(ball.positions.row(h.wing[1])) - a), 0);
    }
    Triangles flipped = ball.triangles;
    std::swap(flipped(20, 0), flipped(20, 1));
    EXPECT_EQ(surface_hinges(flipped, surface_edges(flipped)).size(), hinges.size() - 3);
}

TEST(SurfaceTopology, NeighboursOfAVertexAreTheEndsOfItsEdges) {
    const auto sheet = square_grid(2);
    const VertexNeighbours n = vertex_neighbours(surface_edges(sheet.triangles), 9);
    const std::vector<int> middle(n.vertex.begin() + n.begin[4], n.vertex.begin() + n.begin[5]);
    EXPECT_EQ(middle, (std::vector<int>{0, 1, 3, 5, 7, 8}));
    EXPECT_EQ(n.begin.back(), 2 * surface_edges(sheet.triangles).count());
}

TEST(SurfaceTopology, NormalsOfASpherePointAwayFromItsCentre) {
    const auto ball = sphere(40, 60, 0.1);
    const Points normals = vertex_normals(ball.positions, ball.triangles);
    for (int v = 0; v < normals.rows(); ++v) {
        EXPECT_NEAR(normals.row(v).norm(), 1.0, 1e-14);
        // Faces span 4.5 and 6 degrees, so normals are within a degree of the radius.
        EXPECT_GT(normals.row(v).dot(ball.positions.row(v)) / 0.1, std::cos(M_PI / 180));
    }
}

TEST(SurfaceTopology, AVertexWithoutFacesHasNoNormal) {
    Points p(4, 3);
    p << 0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 5, 5;
    Triangles tri(1, 3);
    tri << 0, 1, 2;
    const Points normals = vertex_normals(p, tri);
    EXPECT_EQ(normals.row(3).norm(), 0.0);
    EXPECT_EQ(normals(0, 2), 1.0);
}

}  // namespace
}  // namespace risorius::geom
