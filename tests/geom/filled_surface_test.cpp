// SPDX-License-Identifier: MIT
// A closed surface filled with tetrahedra: volume, orientation, nodes on the surface, and what is refused.
#include "risorius/geom/filled_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "geom/test_surfaces.h"

namespace risorius::geom {
namespace {

double volume_of(const FilledSurface& solid) {
    double sum = 0;
    for (Eigen::Index t = 0; t < solid.tets.rows(); ++t) {
        const auto at = [&](int k) -> Vec3 {
            return solid.nodes.row(solid.tets(t, k)).transpose();
        };
        const double volume = (at(1) - at(0)).dot((at(2) - at(0)).cross(at(3) - at(0))) / 6;
        EXPECT_GT(volume, 0) << t;
        sum += volume;
    }
    return sum;
}

/// Nodes on triangles that only one tetrahedron has.
std::map<int, int> outer_nodes(const FilledSurface& solid) {
    std::map<std::array<int, 3>, int> uses;
    for (Eigen::Index t = 0; t < solid.tets.rows(); ++t)
        for (int skip = 0; skip < 4; ++skip) {
            std::array<int, 3> face{};
            for (int k = 0, n = 0; k < 4; ++k)
                if (k != skip) face[static_cast<std::size_t>(n++)] = solid.tets(t, k);
            std::sort(face.begin(), face.end());
            ++uses[face];
        }
    std::map<int, int> out;
    for (const auto& [face, count] : uses) {
        EXPECT_LE(count, 2);
        if (count == 1)
            for (const int node : face) ++out[node];
    }
    return out;
}

TEST(FilledSurface, ABallHasItsVolumeAndItsNodesOnTheSphere) {
    const testing::Surface ball = testing::sphere(40, 80, 1);
    double error = 0;
    for (const double spacing : {0.4, 0.2}) {
        NotFilled why{};
        const FilledSurface solid = fill_with_tets(ball.positions, ball.triangles, spacing, why);
        ASSERT_EQ(why, NotFilled::kNothing);
        const double found = volume_of(solid) / (4.0 / 3 * M_PI) - 1;
        EXPECT_LT(found, 0);  // chords
        EXPECT_GT(found, -0.1);
        if (error != 0) {
            EXPECT_LT(std::abs(found), 0.5 * error);  // the square of the spacing: 0.25
        }
        error = std::abs(found);
        int on = 0, all = 0;
        for (const auto& [node, uses] : outer_nodes(solid)) {
            const double radius = solid.nodes.row(node).norm();
            EXPECT_LT(radius, 1 + 0.05 * spacing);
            EXPECT_GT(radius, 1 - spacing);
            on += std::abs(radius - 1) < 0.003;  // the sphere is of flat triangles
            ++all;
        }
        EXPECT_GT(on, 0.9 * all);
    }
}

TEST(FilledSurface, ABoxThatTheLatticeFitsIsFilledExactly) {
    testing::Surface box;
    box.positions.resize(8, 3);
    for (int i = 0; i < 8; ++i) box.positions.row(i) << (i & 1), (i >> 1 & 1), 2 * (i >> 2);
    box.triangles.resize(12, 3);
    box.triangles << 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4,
        6, 0, 6, 2, 1, 3, 7, 1, 7, 5;
    NotFilled why{};
    const FilledSurface solid = fill_with_tets(box.positions, box.triangles, 0.5, why);
    ASSERT_EQ(why, NotFilled::kNothing);
    EXPECT_EQ(solid.tets.rows(), 16 * 6);
    EXPECT_EQ(solid.nodes.rows(), 3 * 3 * 5);
    EXPECT_NEAR(volume_of(solid), 2, 1e-12);

    const FilledSurface coarse = fill_with_tets(box.positions, box.triangles, 0.001, why);
    EXPECT_EQ(why, NotFilled::kTooFine);
    EXPECT_EQ(coarse.tets.rows(), 0);
    fill_with_tets(box.positions, Triangles(box.triangles.topRows(11)), 0.5, why);
    EXPECT_EQ(why, NotFilled::kOpen);
    Triangles turned = box.triangles;
    turned.col(1).swap(turned.col(2));
    fill_with_tets(box.positions, turned, 0.5, why);
    EXPECT_EQ(why, NotFilled::kInsideOut);
    fill_with_tets(testing::sphere(8, 16, 0.3).positions, testing::sphere(8, 16, 0.3).triangles,
                   0.6, why);
    EXPECT_EQ(why, NotFilled::kNothing);
}

}  // namespace
}  // namespace risorius::geom
