// SPDX-License-Identifier: MIT
#include "risorius/tissue/grid_shape.h"

#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "force_term_checks.h"

namespace risorius::tissue {
namespace {

using namespace testing_of;

const GridShape kGrid{4, 3, 5};

double volume_of(const Triangles& triangles, const Points& x) {
    double six_volumes = 0;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        const Vec3 a = x.row(triangles(f, 0)), b = x.row(triangles(f, 1)),
                   c = x.row(triangles(f, 2));
        six_volumes += a.dot(b.cross(c));
    }
    return six_volumes / 6;
}

TEST(GridShape, BlockHasItsCornersWhereItsEdgesEnd) {
    Rigid place = Rigid::Identity();
    place.translate(Vec3(1, 2, 3));
    const Points rest = block_rest(kGrid, Vec3(3, 2, 4), place);
    EXPECT_EQ(Vec3(rest.row(0).transpose()), Vec3(1, 2, 3));
    EXPECT_EQ(Vec3(rest.row(kGrid.size() - 1).transpose()), Vec3(4, 4, 7));
    EXPECT_EQ(Vec3(rest.row(kGrid.index(1, 0, 0)).transpose()), Vec3(2, 2, 3));
}

TEST(GridShape, EnclosedVolumeIsThatOfTheBlockWhereverItStands) {
    Rigid place = Rigid::Identity();
    place.translate(Vec3(100, 200, 300));
    place.rotate(Eigen::AngleAxisd(0.7, Vec3(1, 1, 0).normalized()));
    EXPECT_NEAR(enclosed_volume(kGrid, block_rest(kGrid, Vec3(3, 2, 4), place)), 24, 1e-11);
}

TEST(GridShape, EnclosedVolumeIsTheIntegralOverTrilinearCells) {
    const Points x = block_rest(kGrid, Vec3(3, 2, 4)) + random_points(kGrid.size(), 0.15, 1);
    // 2 x 2 x 2 Gauss points integrate the determinant of a trilinear map exactly.
    double sum = 0;
    const double gauss[2] = {0.5 - 0.5 / std::sqrt(3.0), 0.5 + 0.5 / std::sqrt(3.0)};
    for (int i = 0; i + 1 < kGrid.m; ++i)
        for (int j = 0; j + 1 < kGrid.n; ++j)
            for (int k = 0; k + 1 < kGrid.o; ++k)
                for (int point = 0; point < 8; ++point) {
                    const double t[3] = {gauss[point & 1], gauss[point >> 1 & 1],
                                         gauss[point >> 2]};
                    Mat3 tangents = Mat3::Zero();
                    for (int corner = 0; corner < 8; ++corner) {
                        const int c[3] = {corner & 1, corner >> 1 & 1, corner >> 2};
                        const Vec3 p = x.row(kGrid.index(i + c[0], j + c[1], k + c[2])).transpose();
                        for (int axis = 0; axis < 3; ++axis) {
                            double slope = c[axis] ? 1 : -1;
                            for (int other = 0; other < 3; ++other)
                                if (other != axis) slope *= c[other] ? t[other] : 1 - t[other];
                            tangents.col(axis) += slope * p;
                        }
                    }
                    sum += tangents.determinant() / 8;
                }
    EXPECT_NEAR(enclosed_volume(kGrid, x), sum, 1e-12);
}

TEST(GridShape, SurfaceIsClosedAndSeenFromOutside) {
    const Triangles surface = surface_triangles(kGrid);
    EXPECT_EQ(surface.rows(), 2 * 2 * (3 * 2 + 2 * 4 + 3 * 4));
    EXPECT_NEAR(volume_of(surface, block_rest(kGrid, Vec3(3, 2, 4))), 24, 1e-12);
    std::map<std::pair<int, int>, int> edges;
    for (Eigen::Index f = 0; f < surface.rows(); ++f)
        for (int c = 0; c < 3; ++c) ++edges[{surface(f, c), surface(f, (c + 1) % 3)}];
    for (const auto& [edge, times] : edges) {
        EXPECT_EQ(times, 1);
        EXPECT_TRUE(edges.contains({edge.second, edge.first}));
    }
}

TEST(GridShape, LinesJoinNeighboursOnce) {
    EXPECT_EQ(grid_lines(kGrid).size(), 3u * 3 * 5 + 4u * 2 * 5 + 4u * 3 * 4);
    const Points x = block_rest(kGrid, Vec3(3, 2, 4));  // all spacings are 1
    for (const auto& [a, b] : grid_lines(kGrid)) EXPECT_EQ((x.row(a) - x.row(b)).norm(), 1.0);
}

TEST(GridShape, PlanesHoldTheNodesOfOneIndex) {
    const Points x = block_rest(kGrid, Vec3(3, 2, 4));
    for (int axis = 0; axis < 3; ++axis) {
        const auto nodes = plane_nodes(kGrid, axis, 1);
        EXPECT_EQ(static_cast<int>(nodes.size()), kGrid.size() / kGrid.along(axis));
        for (const int node : nodes) EXPECT_EQ(x(node, axis), 1.0);
    }
}

TEST(GridShape, CylinderIsRoundAndUnfolded) {
    const GridShape grid{3, 9, 9};
    const Points rest = cylinder_rest(grid, 0.01, 0.04);
    for (int j = 0; j < 9; ++j)
        for (int k = 0; k < 9; ++k) {
            const double radius = rest.row(grid.index(1, j, k)).tail<2>().norm();
            if (j == 0 || j == 8 || k == 0 || k == 8)
                EXPECT_NEAR(radius, 0.01, 1e-15);
            else
                EXPECT_LT(radius, 0.00999);
        }
    EXPECT_EQ(rest(grid.index(2, 0, 0), 0), 0.04);
    GridSolid solid{grid, rest, {isotropic_material(1, 0, 0, 1, 0)}};
    EXPECT_NO_THROW(check(solid, "muscle"));
    // A polygon inside a circle: its area is below pi R^2 and converges to it.
    const double round = std::numbers::pi * 1e-4 * 0.04;
    const double coarse = round - enclosed_volume(grid, rest);
    const GridShape fine_grid{3, 17, 17};
    const double fine = round - enclosed_volume(fine_grid, cylinder_rest(fine_grid, 0.01, 0.04));
    EXPECT_GT(fine, 0);
    EXPECT_LT(coarse, 0.03 * round);
    EXPECT_NEAR(coarse / fine, 4.0, 0.3);  // second order
}

}  // namespace
}  // namespace risorius::tissue
