// SPDX-License-Identifier: MIT
#include "risorius/tissue/surface_material.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "risorius/core/error.h"

namespace risorius::tissue {
namespace {

GridSurface sound_sheet() {
    GridSurface surface;
    surface.grid = {4, 3};
    surface.rest = sheet_rest(surface.grid, Vec2(3, 2));
    surface.material = {isotropic_surface(1, 0.1, 0.01, 4, 0.1)};
    return surface;
}

std::string message_of(const GridSurface& surface) {
    try {
        check(surface, "cloth.json:/body");
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(SurfaceMaterial, ASoundSheetAndTubePass) {
    EXPECT_EQ(message_of(sound_sheet()), "no error");
    GridSurface tube = sound_sheet();
    tube.grid = {2, 3, /*closed=*/true};
    tube.rest = tube_rest(tube.grid, 1, 2);
    EXPECT_EQ(message_of(tube), "no error");
}

TEST(SurfaceMaterial, GridsNeedTwoNodesAndThreeAround) {
    GridSurface surface = sound_sheet();
    surface.grid = {1, 3};
    EXPECT_EQ(message_of(surface), "cloth.json:/body/grid/m: expected at least 2 nodes, found 1");
    surface.grid = {4, 1};
    EXPECT_EQ(message_of(surface), "cloth.json:/body/grid/n: expected at least 2 nodes, found 1");
    surface.grid = {4, 2, /*closed=*/true};
    EXPECT_EQ(message_of(surface),
              "cloth.json:/body/grid/n: expected at least 3 nodes around, found 2");
}

TEST(SurfaceMaterial, RestNeedsOneFinitePointPerNode) {
    GridSurface surface = sound_sheet();
    surface.rest.conservativeResize(11, 3);
    EXPECT_EQ(message_of(surface), "cloth.json:/body/rest: expected 4 x 3 = 12 points, found 11");
    surface = sound_sheet();
    surface.rest(5, 1) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(message_of(surface),
              "cloth.json:/body/rest/5: expected three finite numbers, found [1, nan, 0]");
}

TEST(SurfaceMaterial, RestMayNotBeFolded) {
    GridSurface surface = sound_sheet();
    surface.rest.row(4) = surface.rest.row(3);
    EXPECT_EQ(message_of(surface),
              "cloth.json:/body/rest: expected a shape with an area in each corner of every cell, "
              "found none in cell [0, 0]");
    surface = sound_sheet();
    surface.rest.row(4).swap(surface.rest.row(5));
    EXPECT_EQ(message_of(surface),
              "cloth.json:/body/rest: expected a shape without folds, found a folded cell [0, 1]");
    surface = sound_sheet();
    for (int j = 0; j < 3; ++j) surface.rest(surface.grid.index(3, j), 0) = 1.2;
    EXPECT_EQ(message_of(surface),
              "cloth.json:/body/rest: expected a shape without folds, found cell [1, 0] lying on "
              "the next along m");
}

TEST(SurfaceMaterial, ValuesOutOfRangeAreNamed) {
    const auto with = [](auto change) {
        GridSurface surface = sound_sheet();
        change(surface.material[0]);
        return message_of(surface);
    };
    EXPECT_EQ(with([](SurfaceMaterial& m) { m.mass_kg = -4; }),
              "cloth.json:/body/material/mass_kg: expected (0, inf), found -4");
    EXPECT_EQ(with([](SurfaceMaterial& m) { m.mass_kg = 0; }),
              "cloth.json:/body/material/mass_kg: expected (0, inf), found 0");
    EXPECT_EQ(with([](SurfaceMaterial& m) { m.drag_ns_per_m = -0.1; }),
              "cloth.json:/body/material/drag_ns_per_m: expected [0, inf), found -0.1");
    EXPECT_EQ(with([](SurfaceMaterial& m) { m.elastic_n_per_m3(0, 1) = -1; }),
              "cloth.json:/body/material/elastic_n_per_m3/0/1: expected [0, inf), found -1");
    EXPECT_EQ(with([](SurfaceMaterial& m) {
                  m.bending_n_per_m(1, 1) = std::numeric_limits<double>::infinity();
              }),
              "cloth.json:/body/material/bending_n_per_m/1/1: expected [0, inf), found inf");
    EXPECT_EQ(with([](SurfaceMaterial& m) { m.damping_ns_per_m3(1, 0) = 0.5; }),
              "cloth.json:/body/material/damping_ns_per_m3/1/0: expected what stands at 0/1, 0.1, "
              "since the tensor is symmetric, found 0.5");
}

TEST(SurfaceMaterial, OneMaterialOrOnePerNode) {
    GridSurface surface = sound_sheet();
    surface.material.resize(5, surface.material[0]);
    EXPECT_EQ(
        message_of(surface),
        "cloth.json:/body/material: expected 1 material or 4 x 3 = 12, one per node, found 5");
    surface.material.resize(12, surface.material[0]);
    surface.material[7].mass_kg = -1;
    EXPECT_EQ(message_of(surface),
              "cloth.json:/body/material/7/mass_kg: expected (0, inf), found -1");
}

TEST(SurfaceMaterial, MassIsSharedByTheNodes) {
    EXPECT_NEAR(node_mass(sound_sheet()).sum(), 4, 1e-14);
    EXPECT_NEAR(node_drag(sound_sheet()).sum(), 1.2, 1e-14);
}

TEST(SurfaceMaterial, WeightsAreOneOverTheNumberOfLinksAndCells) {
    const SurfaceGrid open{5, 7}, closed{5, 7, /*closed=*/true};
    EXPECT_DOUBLE_EQ(metric_weights(open, Parameters::kResolutionIndependent)(0, 0), 1.0 / 28);
    EXPECT_DOUBLE_EQ(metric_weights(open, Parameters::kResolutionIndependent)(1, 1), 1.0 / 30);
    EXPECT_DOUBLE_EQ(metric_weights(open, Parameters::kResolutionIndependent)(0, 1),
                     0.5 / 28 + 0.5 / 30);
    EXPECT_DOUBLE_EQ(bending_weights(open, Parameters::kResolutionIndependent)(0, 1), 1.0 / 24);
    EXPECT_DOUBLE_EQ(metric_weights(closed, Parameters::kResolutionIndependent)(1, 1), 1.0 / 35);
    EXPECT_EQ(metric_weights(open, Parameters::kPerNode), Mat2::Ones());
}

TEST(SurfaceMaterial, PhysicalConstantsThereAndBack) {
    SheetConstants sheet = sheet_of(5e3, 2e-3);
    EXPECT_DOUBLE_EQ(sheet.membrane_n_per_m(0, 0), 10);
    EXPECT_DOUBLE_EQ(sheet.bending_n_m(0, 1), 10 * 4e-6 / 6);
    sheet.membrane_n_per_m << 10, 4, 4, 25;
    const SheetConstants back =
        sheet_constants(surface_material(sheet, Vec2(3, 0.5)), Vec2(3, 0.5));
    EXPECT_LT((back.membrane_n_per_m - sheet.membrane_n_per_m).cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_LT((back.bending_n_m - sheet.bending_n_m).cwiseAbs().maxCoeff(), 1e-18);
    // For a square, lambda = k / L^2.
    EXPECT_DOUBLE_EQ(surface_material(sheet, Vec2(2, 2)).elastic_n_per_m3(1, 1), 25.0 / 4);
}

TEST(SurfaceMaterial, ATubeIsDrawnFromOutside) {
    const SurfaceGrid grid{5, 9, /*closed=*/true};
    const Points rest = tube_rest(grid, 0.4, 2);
    const Triangles triangles = surface_triangles(grid);
    ASSERT_EQ(triangles.rows(), 2 * 4 * 9);
    for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
        const Vec3 a = rest.row(triangles(t, 0)), b = rest.row(triangles(t, 1));
        const Vec3 c = rest.row(triangles(t, 2));
        const Vec3 outward(0, (a + b + c)[1], (a + b + c)[2]);
        EXPECT_GT((b - a).cross(c - a).dot(outward), 0);
    }
    EXPECT_EQ(grid_lines(grid).size(), 4u * 9 + 5 * 9);
}

}  // namespace
}  // namespace risorius::tissue
