// SPDX-License-Identifier: MIT
#include "risorius/tissue/moduli.h"

#include <gtest/gtest.h>

#include "risorius/tissue/difference_solid.h"
#include "risorius/tissue/grid_shape.h"

namespace risorius::tissue {
namespace {

const Vec3 kEdges(0.3, 0.5, 0.2);
const GridShape kModuliGrid{4, 3, 5};
constexpr double kStrain = 1e-6;  // its second-order effects are below every tolerance here

GridSolid block(const IsotropicModuli& moduli) {
    GridSolid solid{kModuliGrid, block_rest(kModuliGrid, kEdges), {SolidMaterial{}}};
    solid.material[0].elastic_n_per_m3 = block_tensor(moduli.shear_pa, kEdges);
    solid.material[0].incompressibility_n_per_m5 =
        nodal_incompressibility(moduli.volume_pa, kEdges.prod(), kModuliGrid);
    return solid;
}

/// Stress on the face where a_axis is 1, Pa, in a body deformed by x = F r0: the holding force on the nodes divided by the
/// area.
Vec3 traction(const GridSolid& solid, const Mat3& deformation, int axis) {
    const Points x = solid.rest * deformation.transpose();
    Points force = Points::Zero(x.rows(), 3);
    DifferenceSolid(solid).add_force(0, x, force, force);
    Vec3 sum = Vec3::Zero();
    for (const int node : plane_nodes(solid.grid, axis, solid.grid.along(axis) - 1))
        sum -= force.row(node).transpose();
    return sum * kEdges[axis] / kEdges.prod();
}

TEST(Moduli, ABarOfTheMetricTermAloneHasYoungsModulusTwiceItsShearModulus) {
    const GridSolid solid = block({.shear_pa = 2e3, .volume_pa = 0});
    for (int axis = 0; axis < 3; ++axis) {
        Mat3 stretch = Mat3::Identity();
        stretch(axis, axis) += kStrain;
        EXPECT_NEAR(traction(solid, stretch, axis)[axis] / kStrain, 4e3, 4e3 * 1e-5);
    }
}

TEST(Moduli, SimpleShearMeetsTheShearModulusLessWhatTheBorderLacks) {
    const GridSolid solid = block({.shear_pa = 2e3, .volume_pa = 5e4});
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            if (i == j) continue;
            Mat3 shear = Mat3::Identity();
            shear(i, j) = kStrain;
            EXPECT_NEAR(traction(solid, shear, j)[i] / kStrain,
                        2e3 * nodal_shear_fraction(kModuliGrid, i, j), 2e3 * 1e-5)
                << i << j;
        }
    EXPECT_DOUBLE_EQ(nodal_shear_fraction({3, 3, 3}, 0, 1), 2.0 / 3);
    EXPECT_DOUBLE_EQ(nodal_shear_fraction({9, 9, 9}, 0, 1), 8.0 / 9);
}

TEST(Moduli, PressureShrinksTheBodyByItsBulkModulus) {
    const IsotropicModuli moduli = {.shear_pa = 2e3, .volume_pa = 5e4};
    const GridSolid solid = block(moduli);
    const Mat3 squeezed = (1 - kStrain) * Mat3::Identity();
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(-traction(solid, squeezed, axis)[axis] / (3 * kStrain), bulk_modulus(moduli),
                    1e-5 * bulk_modulus(moduli));
}

TEST(Moduli, AFreeBarThinsByPoissonsRatioAndPullsByYoungsModulus) {
    const IsotropicModuli moduli = {.shear_pa = 2e3, .volume_pa = 6e3};
    const GridSolid solid = block(moduli);
    EXPECT_DOUBLE_EQ(poisson_ratio(moduli), 0.375);
    EXPECT_DOUBLE_EQ(youngs_modulus(moduli), 5500);
    Mat3 stretch = (1 - 0.375 * kStrain) * Mat3::Identity();
    stretch(0, 0) = 1 + kStrain;
    EXPECT_NEAR(traction(solid, stretch, 0)[0] / kStrain, 5500, 5500 * 1e-5);
    for (const int side : {1, 2})
        EXPECT_NEAR(traction(solid, stretch, side)[side] / kStrain, 0, 5500 * 1e-5);
}

TEST(Moduli, ConversionsLeadBack) {
    const IsotropicModuli soft = moduli_of_young(9e3, 0.45);
    EXPECT_NEAR(youngs_modulus(soft), 9e3, 1e-9);
    EXPECT_NEAR(poisson_ratio(soft), 0.45, 1e-14);
    const IsotropicModuli same = moduli_of_bulk(soft.shear_pa, bulk_modulus(soft));
    EXPECT_NEAR(same.volume_pa, soft.volume_pa, 1e-9);
    EXPECT_NEAR(bulk_modulus(soft), 9e3 / (3 * (1 - 2 * 0.45)), 1e-9);  // E / (3 (1 - 2 nu))

    const Mat3 moduli = block_moduli(block_tensor(7.0, kEdges), kEdges);
    EXPECT_LT((moduli.array() - 7.0).abs().maxCoeff(), 1e-14);
    EXPECT_DOUBLE_EQ(volume_modulus(incompressibility(5e4, 0.03), 0.03), 5e4);
    EXPECT_DOUBLE_EQ(
        nodal_volume_modulus(nodal_incompressibility(5e4, 0.03, kModuliGrid), 0.03, kModuliGrid),
        5e4);
}

TEST(Moduli, TheThesisCubeIsAFewPascalsStiffAndHardensWithResolution) {
    // lambda = 1.5, psi = 10 per node, edges of 3 m.
    EXPECT_DOUBLE_EQ(block_moduli(Mat3::Constant(1.5), Vec3(3, 3, 3))(0, 1), 4.5);
    EXPECT_DOUBLE_EQ(nodal_volume_modulus(10, 27, {3, 3, 3}), 4320);
    EXPECT_DOUBLE_EQ(nodal_volume_modulus(10, 27, {9, 9, 9}), 64 * 4320);
}

TEST(Moduli, ValuesThatNoParametersCanMakeAreRefused) {
    EXPECT_THROW(moduli_of_young(-1, 0.3), std::invalid_argument);
    EXPECT_THROW(moduli_of_young(1e3, 0.5), std::invalid_argument);
    EXPECT_THROW(moduli_of_young(1e3, -0.1), std::invalid_argument);
    EXPECT_THROW(moduli_of_bulk(1e3, 600), std::invalid_argument);
}

}  // namespace
}  // namespace risorius::tissue
