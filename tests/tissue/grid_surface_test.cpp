// SPDX-License-Identifier: MIT
#include "risorius/tissue/grid_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tissue/term_checks.h"

namespace risorius::tissue {
namespace {

using namespace laws;

/// Anisotropic, and different in every node.
std::vector<SurfaceMaterial> varied_materials(int nodes) {
    std::vector<SurfaceMaterial> materials;
    for (int i = 0; i < nodes; ++i) {
        SurfaceMaterial material;
        material.elastic_n_per_m3 << 20 + i, 7, 7, 12;
        material.damping_ns_per_m3 << 0.6, 0.2 + 0.01 * i, 0.2 + 0.01 * i, 0.9;
        material.bending_n_per_m << 0.5, 0.8, 0.8, 0.3 + 0.02 * i;
        materials.push_back(material);
    }
    return materials;
}

GridSurface varied_sheet() {
    GridSurface surface;
    surface.grid = {5, 4};
    surface.rest = sheet_rest(surface.grid, Vec2(1.2, 0.9));
    surface.material = varied_materials(surface.grid.size());
    return surface;
}

GridSurface varied_tube() {
    GridSurface surface;
    surface.grid = {4, 6, /*closed=*/true};
    surface.rest = tube_rest(surface.grid, 0.3, 1.1);
    surface.material = varied_materials(surface.grid.size());
    return surface;
}

/// A sheet that is neither flat nor evenly spaced.
GridSurface curved_sheet() {
    GridSurface surface = varied_sheet();
    for (Eigen::Index i = 0; i < surface.rest.rows(); ++i) {
        const double x = surface.rest(i, 0), y = surface.rest(i, 1);
        surface.rest.row(i) << x + 0.2 * x * x, y + 0.1 * x * y,
            0.3 * std::sin(2 * x) + 0.2 * y * y;
    }
    return surface;
}

std::string name_of_surface(const testing::TestParamInfo<GridSurface (*)()>& which) {
    static const char* const kNames[] = {"Flat", "Tube", "Curved"};
    return kNames[which.index];
}

class AnyGridSurface : public testing::TestWithParam<GridSurface (*)()> {
  protected:
    GridSurface surface = GetParam()();
    GridSurfaceTerm term{surface};
    Points shape = shaken(surface.rest, 0.1, 1);
};

TEST_P(AnyGridSurface, PassesItsChecks) { EXPECT_NO_THROW(check(surface, "surface")); }
TEST_P(AnyGridSurface, ForceIsTheSlopeOfTheEnergy) { expect_force_is_exact(term, shape); }
TEST_P(AnyGridSurface, PotentialAndItsDerivativesAgree) {
    expect_potential_is_exact(term, surface.rest, shape, 0.02);
}
TEST_P(AnyGridSurface, PositiveCurvatureIsPositive) {
    // Crumpled to half its size.
    expect_positive_curvature(term, surface.rest, 0.5 * shape, 0.02);
}
TEST_P(AnyGridSurface, RestIsFreeOfForceHoweverTurned) { expect_rest_is_free(term, surface.rest); }
TEST_P(AnyGridSurface, InternalForcesAddUpToNothing) {
    expect_no_net_force_or_torque(shape, force_of(term, shape));
}
TEST_P(AnyGridSurface, DampingTakesEnergyOut) { expect_damping_dissipates(term, shape); }
TEST_P(AnyGridSurface, SecantIsTheForce) { expect_secant_is_the_force(term, shape); }
TEST_P(AnyGridSurface, MetricBoundsTheStiffnessAtRest) {
    expect_metric_bounds_rest(term, surface.rest, 0.02, 4.0);
}

INSTANTIATE_TEST_SUITE_P(Rest, AnyGridSurface,
                         testing::Values(&varied_sheet, &varied_tube, &curved_sheet),
                         name_of_surface);

GridSurface plain_sheet(SurfaceGrid grid, const Vec2& size_m, double elastic, double bending,
                        Parameters meant = Parameters::kResolutionIndependent) {
    GridSurface surface;
    surface.grid = grid;
    surface.rest = sheet_rest(grid, size_m);
    surface.material = {isotropic_surface(elastic, 0.1, bending, 1, 0)};
    surface.parameters = surface.bending = meant;
    return surface;
}

TEST(GridSurface, BendsByThePlainQuadraticFormWhenItsRestIsFlat) {
    GridSurface surface = plain_sheet({5, 6}, Vec2(2, 3), 0, 1, Parameters::kPerNode);
    surface.material[0].bending_n_per_m << 0.3, 0.7, 0.7, 0.2;
    const Points x = shaken(surface.rest, 0.5, 2);
    const auto at = [&](int i, int j) -> Eigen::RowVector3d {
        return x.row(surface.grid.index(i, j));
    };
    double expected = 0;
    for (int i = 0; i < 5; ++i)
        for (int j = 0; j < 6; ++j) {
            if (i > 0 && i < 4)
                expected +=
                    0.15 * (16 * (at(i - 1, j) - 2 * at(i, j) + at(i + 1, j))).squaredNorm();
            if (j > 0 && j < 5)
                expected += 0.1 * (25 * (at(i, j - 1) - 2 * at(i, j) + at(i, j + 1))).squaredNorm();
            if (i < 4 && j < 5)
                expected += 0.7 * (20 * (at(i + 1, j + 1) - at(i + 1, j) - at(i, j + 1) + at(i, j)))
                                      .squaredNorm();
        }
    const GridSurfaceTerm term(surface);
    EXPECT_NEAR(term.bending_energy(x), expected, 1e-12 * expected);
    EXPECT_EQ(term.metric_energy(x), 0.0);
}

TEST(GridSurface, RollingAFlatSheetUpCostsNoMetricEnergy) {
    const GridSurface surface = plain_sheet({9, 5}, Vec2(1, 0.5), 50, 0.2);
    // Chords are as long as the spacing, so the links keep their length.
    const double angle = 0.3, radius = 0.125 / (2 * std::sin(angle / 2));
    Points rolled = surface.rest;
    for (int i = 0; i < 9; ++i)
        for (int j = 0; j < 5; ++j)
            rolled.row(surface.grid.index(i, j)) << radius * std::sin(i * angle),
                surface.rest(surface.grid.index(i, j), 1), radius * (1 - std::cos(i * angle));
    const GridSurfaceTerm term(surface);
    EXPECT_LT(term.metric_energy(rolled), 1e-25);
    // 7 inner rows of 1/8 each, |D_11 r| = L^2 2 sin(angle/2) / spacing.
    const double second = 64 * 0.125 * 2 * std::sin(angle / 2);
    EXPECT_NEAR(term.bending_energy(rolled), 7.0 / 8 * 0.5 * 0.2 * second * second, 1e-12);
}

TEST(GridSurface, WideningATubeCostsTheChangeOfItsSecondDifference) {
    GridSurface tube;
    tube.grid = {3, 24, /*closed=*/true};
    tube.rest = tube_rest(tube.grid, 0.5, 1);
    tube.material = {isotropic_surface(0, 0, 1, 1, 0)};
    const GridSurfaceTerm term(tube);
    const Points wide = tube_rest(tube.grid, 0.6, 1);
    // D_22 of a circle of radius r has the length r w^2, w = 2 N sin(pi / N). The normal part keeps its own length.
    const double w = 2 * 24 * std::sin(std::numbers::pi / 24);
    const double expected = 0.5 * std::pow(0.1 * w * w, 2);
    EXPECT_NEAR(term.bending_energy(wide), expected, 1e-10 * expected);
}

/// Sag of the middle of a strip that is supported at both ends, under its own weight, divided by the beam's 5 q / (384 zeta).
double pinned_sag_ratio(int nodes, Parameters meant, double zeta) {
    const GridSurface surface = plain_sheet({nodes, 3}, Vec2(1, 0.3), 1e4, zeta, meant);
    std::vector<char> fixed(static_cast<std::size_t>(surface.grid.size()), 0);
    Points load = Points::Zero(surface.grid.size(), 3);
    for (int i = 0; i < nodes; ++i)
        for (int j = 0; j < 3; ++j) {
            const int node = surface.grid.index(i, j);
            fixed[static_cast<std::size_t>(node)] = i == 0 || i == nodes - 1;
            load(node, 2) = -1.0 / ((nodes - 1) * 3);
        }
    const Points u = small_deflection(GridSurfaceTerm(surface), surface.rest, fixed, load);
    return -u(surface.grid.index(nodes / 2, 1), 2) / (5.0 / 384 / zeta);
}

TEST(GridSurface, APinnedSheetSagsByTheBeamFormulaAtAnyResolution) {
    // The discrete beam differs from the continuous one by h^2: exact sums give 1 + 0.8 h^2.
    for (const int nodes : {5, 9, 17, 33}) {
        const double h = 1.0 / (nodes - 1);
        EXPECT_NEAR(pinned_sag_ratio(nodes, Parameters::kResolutionIndependent, 0.2), 1,
                    1.0 * h * h)
            << nodes;
    }
}

TEST(GridSurface, ValuesPerNodeMakeAFinerSheetStiffer) {
    // With the thesis' values, zeta per node counts (M - 1) N times.
    for (const int nodes : {5, 9})
        EXPECT_NEAR(
            pinned_sag_ratio(nodes, Parameters::kPerNode, 0.2),
            pinned_sag_ratio(nodes, Parameters::kResolutionIndependent, 0.2) / ((nodes - 1) * 3),
            1e-3)
            << nodes;
}

TEST(GridSurface, ACantileverOfTwoClampedRowsIsShorterByHalfASpacing) {
    for (const int nodes : {7, 13, 25}) {
        const double zeta = 0.3, h = 1.0 / (nodes - 1);
        const GridSurface surface = plain_sheet({nodes, 3}, Vec2(1, 0.3), 1e4, zeta);
        std::vector<char> fixed(static_cast<std::size_t>(surface.grid.size()), 0);
        Points load = Points::Zero(surface.grid.size(), 3);
        for (int j = 0; j < 3; ++j) {
            fixed[static_cast<std::size_t>(surface.grid.index(0, j))] = 1;
            fixed[static_cast<std::size_t>(surface.grid.index(1, j))] = 1;
            load(surface.grid.index(nodes - 1, j), 2) = -1e-3 / 3;
        }
        const Points u = small_deflection(GridSurfaceTerm(surface), surface.rest, fixed, load);
        const double tip = -u(surface.grid.index(nodes - 1, 1), 2);
        EXPECT_NEAR(tip * 3 * zeta / 1e-3, std::pow(1 - h / 2, 3), h * h) << nodes;
        // Sum over the hinges: h^3 sum k^2 over k = 1 .. M-2.
        const double n = nodes - 1;
        EXPECT_NEAR(tip * 3 * zeta / 1e-3, (n - 1) * (2 * n - 1) / (2 * n * n), 1e-4) << nodes;
    }
}

TEST(GridSurface, HangsFromItsUpperRowByTheClosedForm) {
    // Row k from the free end carries m g k / M. Its stretch solves s^3 - s = T L1^-3 / lambda, as for the solid, but in 2-D.
    const int m = 6;
    const double mg = 9.81, lambda = 3, length = 2;
    GridSurface surface = plain_sheet({m, 4}, Vec2(length, 1), 1, 0);
    surface.material[0].elastic_n_per_m3 << lambda, 0, 0, 0;
    const GridSurfaceTerm term(surface);
    Points x = surface.rest;
    double at = 0;
    for (int i = 1; i < m; ++i) {
        const double tension = mg * (m - i) / m;
        double s = 1.5;
        for (int k = 0; k < 50; ++k)
            s -= (s * s * s - s - tension / (lambda * length * length * length)) / (3 * s * s - 1);
        at += s * length / (m - 1);
        for (int j = 0; j < 4; ++j) x(surface.grid.index(i, j), 0) = at;
    }
    const Points force = force_of(term, x);
    for (int i = 1; i < m; ++i)
        for (int j = 0; j < 4; ++j)
            EXPECT_NEAR(force(surface.grid.index(i, j), 0), -mg / (m * 4), 1e-10);
}

TEST(GridSurface, TwoByTwoNodesOnlyTwist) {
    const GridSurface surface = plain_sheet({2, 2}, Vec2(1, 1), 0, 1);
    Points twisted = surface.rest;
    twisted(3, 2) = 0.1;
    EXPECT_NEAR(GridSurfaceTerm(surface).bending_energy(twisted), 0.01, 1e-15);
}

}  // namespace
}  // namespace risorius::tissue
