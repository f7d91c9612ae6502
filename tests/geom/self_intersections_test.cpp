// SPDX-License-Identifier: MIT
#include "risorius/geom/self_intersections.h"

#include <gtest/gtest.h>

namespace risorius::geom {
namespace {

using Pairs = std::vector<std::array<int, 2>>;

// A triangle in the plane y = 0, and one that stands on a corner at the given height.
Pairs cuts_at(double height) {
    Points points(6, 3);
    points << 0, 0, 0, 4, 0, 0, 0, 0, 4, 1, height, 1, 0, height + 2, 1, 2, height + 2, 1;
    Triangles triangles(2, 3);
    triangles << 0, 1, 2, 3, 4, 5;
    return self_intersections(points, triangles);
}

TEST(SelfIntersections, ATriangleThroughAnotherIsOnePair) {
    EXPECT_EQ(cuts_at(-1), (Pairs{{0, 1}}));
}

TEST(SelfIntersections, TouchingAndStandingApartAreNone) {
    EXPECT_TRUE(cuts_at(0).empty());
    EXPECT_TRUE(cuts_at(0.01).empty());
}

TEST(SelfIntersections, NeighboursMayFoldOntoEachOther) {
    // Two triangles with a common edge, folded until they nearly coincide. They are connected, so this is no pair.
    Points points(4, 3);
    points << 0, 0, 0, 1, 0, 0, 0.5, 0, 1, 0.5, 0.001, 0.9;
    Triangles triangles(2, 3);
    triangles << 0, 1, 2, 1, 0, 3;
    EXPECT_TRUE(self_intersections(points, triangles).empty());
}

}  // namespace
}  // namespace risorius::geom
