// SPDX-License-Identifier: MIT
// The hanging cube in finite differences: acceptance tests T4 and T5.
#include "tissue/hanging_cube.h"

#include <gtest/gtest.h>

#include <map>

#include "risorius/tissue/difference_solid.h"

namespace risorius::tissue {
namespace {

const SolidMaterial kThesisCube = isotropic_material(1.5, 0.1, 10, 4, 0);

Points hanging(const GridSolid& solid) {
    return equilibrium(hang<DifferenceSolid>(solid), solid.rest);
}

TEST(HangingCube, FigureFiveTheOriginalParametersDependOnTheResolution) {
    // T4a: eta = 0.01 in every node. The values are those of the closed form; figure 5 shows only pictures.
    const std::map<int, double> expected = {{3, 1.7854}, {4, 1.4212}, {5, 1.2483}};
    for (const auto& [nodes, length] : expected) {
        const GridSolid solid =
            hanging_cube(nodes, isotropic_material(0.01, 0.001, 0, 4, 0), Parameters::kPerNode);
        const double found = hang_length(solid.grid, hanging(solid));
        EXPECT_NEAR(found, closed_form_hang_length(nodes, 0.01 * nodes * nodes * (nodes - 1), 4),
                    1e-8);
        EXPECT_NEAR(found, length, 1e-4);
    }
}

TEST(HangingCube, EquationTenMakesTheParametersIndependentOfTheResolution) {
    // T4b
    const std::map<int, double> expected = {{3, 1.1839}, {4, 1.1824}, {5, 1.1815}};
    for (const auto& [nodes, length] : expected) {
        const GridSolid solid = hanging_cube(nodes, isotropic_material(1.5, 0.1, 0, 4, 0));
        const double found = hang_length(solid.grid, hanging(solid));
        EXPECT_NEAR(found, closed_form_hang_length(nodes, 1.5, 4), 1e-8);
        EXPECT_NEAR(found, length, 1e-4);
    }
}

TEST(HangingCube, HangsAlmostTheSameAtEveryResolutionWithTheVolumeTerm) {
    // T4c and T5c. The volume change is in per cent; the thesis finds about 1 at 9^3. Lengths and changes are those of an
    // independent prototype. At 11^3 and 13^3 they are 1.1397, 0.660 and 1.1377, 0.482, which is too slow for a test.
    struct Row {
        int nodes;
        double length, volume_percent;
    };
    double shortest = 10, longest = 0;
    for (const Row& row :
         {Row{3, 1.1651, 6.96}, Row{5, 1.1529, 2.85}, Row{7, 1.1464, 1.54}, Row{9, 1.1424, 0.96}}) {
        const GridSolid solid = hanging_cube(row.nodes, kThesisCube);
        const Points x = hanging(solid);
        const double length = hang_length(solid.grid, x), volume = 100 * volume_change(solid, x);
        EXPECT_NEAR(length, row.length, 1e-4) << row.nodes;
        EXPECT_NEAR(volume, row.volume_percent, 0.005) << row.nodes;
        shortest = std::min(shortest, length);
        longest = std::max(longest, length);
    }
    EXPECT_LT(longest / shortest, 1.025);
}

TEST(HangingCube, DriftsSidewaysSinceTheDifferencesLookToOneSide) {
    // A known defect of the discretisation, 0.8 % of L at 3^3. A change here is a change of the reference.
    const GridSolid solid = hanging_cube(3, kThesisCube);
    const Points x = hanging(solid);
    EXPECT_NEAR((x.col(0) - solid.rest.col(0)).mean() / kCubeEdge, -0.0079, 1e-4);
    EXPECT_NEAR((x.col(1) - solid.rest.col(1)).mean() / kCubeEdge, -0.0079, 1e-4);
}

TEST(HangingCube, SofteningTheLowerHalfStretchesTheLowerHalf) {
    // Inhomogeneous: links of the lower half have a quarter of lambda. Without the volume term, columns do not interact.
    GridSolid solid = hanging_cube(5, isotropic_material(1.5, 0.1, 0, 4, 0));
    const Points even = hanging(solid);
    solid.material.assign(125, solid.material[0]);
    for (int k = 0; k < 2; ++k)
        for (const int node : plane_nodes(solid.grid, 2, k))
            solid.material[static_cast<std::size_t>(node)].elastic_n_per_m3 /= 4;
    const Points softened = hanging(solid);
    const auto gap = [&](const Points& x, int k) {
        return x(solid.grid.index(2, 2, k + 1), 2) - x(solid.grid.index(2, 2, k), 2);
    };
    for (int k = 0; k < 4; ++k) {
        const double pull = 4 * kStandardGravity * (k + 1) / 5 / (1.5 * 27) * (k < 2 ? 4 : 1);
        const double s = gap(softened, k) / 0.75;
        EXPECT_NEAR(s * s * s - s, pull, 1e-8) << k;
        if (k < 2)
            EXPECT_GT(gap(softened, k), 1.15 * gap(even, k)) << k;
        else
            EXPECT_NEAR(gap(softened, k), gap(even, k), 1e-8) << k;
    }
}

TEST(HangingCube, OnlyTheStiffnessAlongThePullCountsInAnAnisotropicBar) {
    GridSolid solid = hanging_cube(4, isotropic_material(1.5, 0.1, 0, 4, 0));
    const double isotropic = hang_length(solid.grid, hanging(solid));
    solid.material[0].elastic_n_per_m3(0, 0) = solid.material[0].elastic_n_per_m3(1, 1) = 15;
    EXPECT_NEAR(hang_length(solid.grid, hanging(solid)), isotropic, 1e-9);
    solid.material[0].elastic_n_per_m3(2, 2) = 3;
    EXPECT_NEAR(hang_length(solid.grid, hanging(solid)), closed_form_hang_length(4, 3, 4), 1e-8);
}

}  // namespace
}  // namespace risorius::tissue
