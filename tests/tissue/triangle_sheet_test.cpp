// SPDX-License-Identifier: MIT
#include "risorius/tissue/triangle_sheet.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "risorius/core/error.h"
#include "risorius/tissue/grid_surface.h"
#include "risorius/tissue/skin_sheet.h"
#include "tissue/term_checks.h"

namespace risorius::tissue {
namespace {

using namespace laws;

GridSurface grid_of(SurfaceGrid grid, const Points& rest, const SurfaceMaterial& material) {
    GridSurface surface;
    surface.grid = grid;
    surface.rest = rest;
    surface.material = {material};
    return surface;
}

SurfaceMaterial anisotropic() {
    SurfaceMaterial material;
    material.elastic_n_per_m3 << 20, 7, 7, 12;
    material.damping_ns_per_m3 << 0.6, 0.2, 0.2, 0.9;
    material.bending_n_per_m << 0.5, 0.8, 0.8, 0.3;
    return material;
}

TriangleSurface flat_sheet() {
    const SurfaceGrid grid{4, 4};
    Points rest = sheet_rest(grid, Vec2(1.2, 0.9));
    for (const int node : {5, 6, 9, 10}) rest.row(node) += Eigen::RowVector3d(0.05, -0.03, 0);
    return triangulated(grid_of(grid, rest, anisotropic()));
}
TriangleSurface tube() {
    const SurfaceGrid grid{4, 6, /*closed=*/true};
    return triangulated(grid_of(grid, tube_rest(grid, 0.3, 1.1), anisotropic()));
}
TriangleSurface curved_triangles() {
    TriangleSurface surface = flat_sheet();
    for (Eigen::Index i = 0; i < surface.rest.rows(); ++i)
        surface.rest(i, 2) = 0.3 * std::sin(2 * surface.rest(i, 0)) + 0.2 * surface.rest(i, 1);
    return surface;
}

TriangleSurface irregular_sheet() {
    const SurfaceGrid grid{5, 5};
    return irregularly_triangulated(grid_of(grid, sheet_rest(grid, Vec2(1.2, 0.9)), anisotropic()),
                                    0.4, 3);
}
/// An octahedron, subdivided once and projected to a sphere: closed, with four or six triangles at each point, and its own
/// fibre direction in each triangle.
TriangleSurface ball() {
    TriangleSurface surface;
    surface.rest.resize(18, 3);
    surface.rest.topRows(6) << 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1;
    int points = 6;
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
        const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), points);
        if (is_new)
            surface.rest.row(points++) = (surface.rest.row(a) + surface.rest.row(b)).normalized();
        return at->second;
    };
    surface.triangles.resize(32, 3);
    Eigen::Index t = 0;
    for (const auto& [a, b, c] : {std::array{0, 2, 4},
                                  {2, 1, 4},
                                  {1, 3, 4},
                                  {3, 0, 4},
                                  {2, 0, 5},
                                  {1, 2, 5},
                                  {3, 1, 5},
                                  {0, 3, 5}}) {
        const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        for (const auto& [p, q, r] :
             {std::array{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}})
            surface.triangles.row(t++) << p, q, r;
    }
    surface.rest *= 0.4;
    surface.material = {anisotropic()};
    surface.coordinates = fibre_coordinates(surface.triangles, surface.rest,
                                            Vec3(1, 0.3, 0.2).transpose().replicate(t, 1));
    return surface;
}

class AnyTriangleSheet : public testing::TestWithParam<TriangleSurface (*)()> {
  protected:
    TriangleSurface surface = GetParam()();
    TriangleSheetTerm term{surface};
    Points shape = shaken(surface.rest, 0.05, 1);
};

TEST_P(AnyTriangleSheet, PassesItsChecks) { EXPECT_NO_THROW(check(surface, "sheet")); }
TEST_P(AnyTriangleSheet, ForceIsTheSlopeOfTheEnergy) { expect_force_is_exact(term, shape); }
TEST_P(AnyTriangleSheet, PotentialAndItsDerivativesAgree) {
    expect_potential_is_exact(term, surface.rest, shape, 0.02);
}
TEST_P(AnyTriangleSheet, PositiveCurvatureIsPositive) {
    expect_positive_curvature(term, surface.rest, 0.5 * shape, 0.02);
}
TEST_P(AnyTriangleSheet, RestIsFreeOfForceHoweverTurned) {
    expect_rest_is_free(term, surface.rest);
}
TEST_P(AnyTriangleSheet, InternalForcesAddUpToNothing) {
    expect_no_net_force_or_torque(shape, force_of(term, shape));
}
TEST_P(AnyTriangleSheet, DampingTakesEnergyOut) { expect_damping_dissipates(term, shape); }
TEST_P(AnyTriangleSheet, SecantIsTheForce) { expect_secant_is_the_force(term, shape); }

std::string name_of_triangles(const testing::TestParamInfo<TriangleSurface (*)()>& which) {
    static const char* const kNames[] = {"Flat", "Tube", "Curved", "Irregular", "Ball"};
    return kNames[which.index];
}
INSTANTIATE_TEST_SUITE_P(Rest, AnyTriangleSheet,
                         testing::Values(&flat_sheet, &tube, &curved_triangles, &irregular_sheet,
                                         &ball),
                         name_of_triangles);

TEST(TriangleSheet, MetricBoundsTheStiffnessOfAFlatSheet) {
    const TriangleSurface surface = flat_sheet();
    expect_metric_bounds_rest(TriangleSheetTerm(surface), surface.rest, 0.02, 4.0);
}

/// Equilateral triangles in rows, about 1 m in each direction, with material coordinates in metres.
TriangleSurface equilateral(int rows, double bending_n_m) {
    TriangleSurface surface;
    const double side = 1.0 / rows, height = side * std::sqrt(0.75);
    surface.rest.resize((rows + 1) * (rows + 1), 3);
    surface.triangles.resize(2 * rows * rows, 3);
    Eigen::Index t = 0;
    const auto at = [&](int i, int j) { return i * (rows + 1) + j; };
    for (int i = 0; i <= rows; ++i)
        for (int j = 0; j <= rows; ++j)
            surface.rest.row(at(i, j)) << side * (j + 0.5 * (i % 2)), height * i, 0;
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < rows; ++j) {
            const int a = at(i, j), b = at(i, j + 1), c = at(i + 1, j), d = at(i + 1, j + 1);
            if (i % 2 == 0) {
                surface.triangles.row(t++) << a, b, c;
                surface.triangles.row(t++) << b, d, c;
            } else {
                surface.triangles.row(t++) << a, b, d;
                surface.triangles.row(t++) << a, d, c;
            }
        }
    surface.material = {isotropic_surface(0, 0, bending_n_m, 1, 0)};
    surface.coordinates = fibre_coordinates(surface.triangles, surface.rest,
                                            Vec3::UnitX().transpose().replicate(t, 1));
    return surface;
}

/// Bending energy of z = 1/2 x . b x divided by that of the plate it represents, inside and at the border.
double energy_ratio(const TriangleSurface& surface, const Mat2& b, double plate_n_m) {
    Points x = surface.rest;
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
        const Vec2 p = x.row(i).head<2>().transpose();
        x(i, 2) = 1e-4 * 0.5 * p.dot(b * p);
    }
    double area = 0;
    for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t)
        area += area_of(coordinates_of(surface, t));
    return TriangleSheetTerm(surface).bending_energy(x) /
           (0.5 * plate_n_m * 1e-8 * b.squaredNorm() * area);
}

TEST(TriangleSheet, BendsLikeThePlateOnAnyTrianglesInAnyDirection) {
    Mat2 across, along, twist, bowl;
    along << 1, 0, 0, 0;
    across << 0.25, 0.433, 0.433, 0.75;
    twist << 0, 1, 1, 0;
    bowl << 1, 0, 0, 1;
    for (const Mat2& b : {along, across, twist, bowl}) {
        // Triangles with all three neighbours are exact. Those at the border relax, which is an effect of order h.
        const double coarse = energy_ratio(equilateral(10, 0.7), b, 0.7);
        const double fine = energy_ratio(equilateral(20, 0.7), b, 0.7);
        EXPECT_LT(fine, 1.0001);
        EXPECT_GT(fine, 0.9);
        EXPECT_NEAR(1 - fine, 0.5 * (1 - coarse), 0.02);
    }
}

TEST(TriangleSheet, HingesOfTheSkinRollAsThePlateDoes) {
    // Rolled along x: energy per area divided by D/2 curvature^2. Edges at the border, one in forty, do not bend.
    const auto ratio = [](const Triangles& triangles, const Points& rest, double hinge_n_m) {
        const Eigen::VectorXd none = Eigen::VectorXd::Zero(triangles.rows());
        const SkinSheet skin(triangles, rest, none,
                             Eigen::VectorXd::Constant(triangles.rows(), hinge_n_m));
        Points x = rest, ignored = Points::Zero(rest.rows(), 3);
        for (Eigen::Index i = 0; i < x.rows(); ++i) x(i, 2) = 0.5e-4 * x(i, 0) * x(i, 0);
        double area = 0;
        for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
            const Vec3 p = rest.row(triangles(t, 0)), q = rest.row(triangles(t, 1));
            area += 0.5 * (q - p).cross(Vec3(rest.row(triangles(t, 2))) - p).norm();
        }
        return skin.add_energy(x, ignored) / (0.5 * 0.7 * 1e-8 * area);
    };
    const TriangleSurface lattice = equilateral(40, 0);
    EXPECT_NEAR(ratio(lattice.triangles, lattice.rest, hinge_bending(0.7)), 1, 0.05);
    const SurfaceGrid grid{41, 41};
    EXPECT_NEAR(ratio(surface_triangles(grid), sheet_rest(grid, Vec2(1, 1)), hinge_bending(0.7)), 1,
                0.05);
}

TEST(TriangleSheet, FlatteningAnArchCostsItsCurvature) {
    const SurfaceGrid grid{41, 9};
    const double radius = 0.6, plate = 0.3;
    const Points flat = sheet_rest(grid, Vec2(1, 0.5));
    Points arch = flat;
    for (Eigen::Index i = 0; i < arch.rows(); ++i) {
        const double angle = flat(i, 0) / radius;
        arch(i, 0) = radius * std::sin(angle);
        arch(i, 2) = radius * (1 - std::cos(angle));
    }
    SheetConstants sheet;
    sheet.bending_n_m.setConstant(plate);
    const TriangleSheetTerm term(
        triangulated(grid_of(grid, arch, surface_material(sheet, Vec2(1, 0.5)))));
    const double expected = 0.5 * plate / (radius * radius) * 0.5;
    // The outer triangles of the end columns, one of 80 each, have no fold along the arch.
    EXPECT_NEAR(term.bending_energy(flat), expected * 78 / 80, 2e-3 * expected);
    EXPECT_LT(term.bending_energy(arch), 1e-20);
}

TEST(TriangleSheet, APinnedSheetSagsAsTheGridDoes) {
    const double zeta = 0.2;
    double before = 0;
    for (const int nodes : {9, 17}) {
        const SurfaceGrid grid{nodes, nodes};
        const GridSurface surface =
            grid_of(grid, sheet_rest(grid, Vec2(1, 1)), isotropic_surface(1e4, 0, zeta, 1, 0));
        std::vector<char> fixed(static_cast<std::size_t>(grid.size()), 0);
        Points load = Points::Zero(grid.size(), 3);
        load.col(2) = -node_mass(surface);
        for (int j = 0; j < nodes; ++j)
            fixed[static_cast<std::size_t>(grid.index(0, j))] =
                fixed[static_cast<std::size_t>(grid.index(nodes - 1, j))] = 1;
        const int middle = grid.index(nodes / 2, nodes / 2);
        const double by_grid =
            small_deflection(GridSurfaceTerm(surface), surface.rest, fixed, load)(middle, 2);
        const double by_triangles = small_deflection(TriangleSheetTerm(triangulated(surface)),
                                                     surface.rest, fixed, load)(middle, 2);
        const double difference = std::abs(by_triangles / by_grid - 1);
        EXPECT_LT(difference, 0.06) << nodes;
        if (before > 0) {
            EXPECT_LT(difference, 0.7 * before);
        }
        before = difference;
    }
}

/// Distance between the lowest points of the same cloth in both equilibria, divided by the sag of the grid. Each has its own
/// mass: the grid distributes it evenly, borders included, and triangles distribute it by area.
double sag_difference(const SurfaceGrid& grid, const std::vector<char>& fixed) {
    const GridSurface surface =
        grid_of(grid, sheet_rest(grid, Vec2(3, 3)), isotropic_surface(2, 0.1, 0.01, 4, 0.1));
    const TriangleSurface triangles = triangulated(surface);
    Points load = Points::Zero(grid.size(), 3);
    load.col(2) = -9.81 * node_mass(surface);
    Points by_grid = surface.rest, by_triangles = surface.rest;
    EXPECT_TRUE(solve(GridSurfaceTerm(surface), fixed, load, by_grid));
    load.col(2) = -9.81 * node_mass(triangles);
    EXPECT_TRUE(solve(TriangleSheetTerm(triangles), fixed, load, by_triangles));
    const double sag = -by_grid.col(2).minCoeff();
    EXPECT_GT(sag, 0.5);
    return std::abs(-by_triangles.col(2).minCoeff() - sag) / sag;
}

TEST(TriangleSheet, AHammockOfTheSameMaterialSagsAsTheGridDoes) {
    // A node between the supports has 1/N of a strip's mass on the grid and 1/(N-1) on triangles.
    double before = 0.1;
    for (const int nodes : {7, 13, 25}) {
        const SurfaceGrid grid{nodes, nodes};
        std::vector<char> fixed(static_cast<std::size_t>(grid.size()), 0);
        for (int i = 0; i < nodes; ++i)
            fixed[static_cast<std::size_t>(grid.index(i, 0))] =
                fixed[static_cast<std::size_t>(grid.index(i, nodes - 1))] = 1;
        const double difference = sag_difference(grid, fixed);
        EXPECT_LT(difference, before) << nodes;
        before = 0.7 * difference;
    }
}

TEST(TriangleSheet, IrregularTrianglesSagAsRegularOnesDo) {
    const SurfaceGrid grid{13, 13};
    const GridSurface surface =
        grid_of(grid, sheet_rest(grid, Vec2(3, 3)), isotropic_surface(2, 0.1, 0.01, 4, 0.1));
    std::vector<char> fixed(static_cast<std::size_t>(grid.size()), 0);
    for (int i = 0; i < 13; ++i)
        fixed[static_cast<std::size_t>(grid.index(i, 0))] =
            fixed[static_cast<std::size_t>(grid.index(i, 12))] = 1;
    const auto sag = [&](const TriangleSurface& sheet) {
        Points x = sheet.rest, load = Points::Zero(grid.size(), 3);
        load.col(2) = -9.81 * node_mass(sheet);
        EXPECT_TRUE(solve(TriangleSheetTerm(sheet), fixed, load, x));
        return -x.col(2).minCoeff();
    };
    const double regular = sag(triangulated(surface));
    EXPECT_GT(regular, 0.5);
    for (const unsigned seed : {1u, 2u})
        EXPECT_NEAR(sag(irregularly_triangulated(surface, 0.4, seed)), regular, 0.01 * regular)
            << seed;
}

TEST(TriangleSheet, IrregularTrianglesCoverTheSheetOnce) {
    const SurfaceGrid grid{6, 5};
    const GridSurface surface = grid_of(grid, sheet_rest(grid, Vec2(3, 2)), anisotropic());
    const TriangleSurface sheet = irregularly_triangulated(surface, 0.45, 5);
    double in_space = 0, in_a = 0;
    for (Eigen::Index t = 0; t < sheet.triangles.rows(); ++t) {
        const Vec3 p = sheet.rest.row(sheet.triangles(t, 0)),
                   q = sheet.rest.row(sheet.triangles(t, 1)),
                   r = sheet.rest.row(sheet.triangles(t, 2));
        EXPECT_GT((q - p).cross(r - p).z(), 0) << "upwards, like the grid";
        in_space += 0.5 * (q - p).cross(r - p).norm();
        in_a += area_of(coordinates_of(sheet, t));
    }
    EXPECT_NEAR(in_space, 6, 1e-12);
    EXPECT_NEAR(in_a, 1, 1e-12);
    EXPECT_GT((sheet.rest - surface.rest).rowwise().norm().maxCoeff(), 0.1);
    EXPECT_EQ(irregularly_triangulated(surface, 0.45, 5).rest, sheet.rest) << "same seed";
    EXPECT_NE(irregularly_triangulated(surface, 0.45, 6).rest, sheet.rest);
    EXPECT_EQ(irregularly_triangulated(surface, 0, 5).rest, surface.rest);
}

TEST(TriangleSheet, AClothHungByThreeCornersSagsAsTheGridDoes) {
    // Three nodes hold single points. The stress there grows with the resolution, and the two discretisations see it
    // differently.
    for (const int nodes : {7, 13}) {
        const SurfaceGrid grid{nodes, nodes};
        std::vector<char> fixed(static_cast<std::size_t>(grid.size()), 0);
        const int last = nodes - 1;
        for (const auto& [i, j] : {std::pair(0, 0),
                                   {1, 0},
                                   {0, 1},
                                   {last, 0},
                                   {last - 1, 0},
                                   {last, 1},
                                   {0, last},
                                   {1, last},
                                   {0, last - 1}})
            fixed[static_cast<std::size_t>(grid.index(i, j))] = 1;
        EXPECT_LT(sag_difference(grid, fixed), 0.07) << nodes;
    }
}

std::string message_of(const TriangleSurface& surface) {
    try {
        check(surface, "skin.json:/body");
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(TriangleSheet, WhatIsWrongIsNamed) {
    TriangleSurface surface = flat_sheet();
    surface.triangles(3, 1) = 16;
    EXPECT_EQ(message_of(surface),
              "skin.json:/body/triangles/3: expected points 0 to 15, found 16");
    surface = flat_sheet();
    surface.triangles(2, 1) = surface.triangles(2, 0);
    EXPECT_EQ(message_of(surface),
              "skin.json:/body/triangles/2: expected an area at rest, found none");
    surface = flat_sheet();
    surface.rest(4, 2) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(message_of(surface),
              "skin.json:/body/rest/4: expected three finite numbers, found one that is not");
    surface = flat_sheet();
    surface.coordinates.row(1).setZero();
    EXPECT_EQ(
        message_of(surface),
        "skin.json:/body/coordinates/1: expected an area in material coordinates, found none");
    surface = flat_sheet();
    surface.material.resize(2);
    EXPECT_EQ(message_of(surface),
              "skin.json:/body/material: expected 1 material or 18, one per triangle, found 2");
    surface.material.resize(1);
    surface.material[0].mass_kg = -1;
    EXPECT_EQ(message_of(surface), "skin.json:/body/material/mass_kg: expected (0, inf), found -1");
}

TEST(TriangleSheet, MassIsTheGrids) {
    const SurfaceGrid grid{5, 6, /*closed=*/true};
    EXPECT_NEAR(node_mass(triangulated(grid_of(grid, tube_rest(grid, 1, 2),
                                               isotropic_surface(1, 0, 1, 4, 0))))
                    .sum(),
                4, 1e-13);
}

}  // namespace
}  // namespace risorius::tissue
