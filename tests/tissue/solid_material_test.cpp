// SPDX-License-Identifier: MIT
#include "risorius/tissue/solid_material.h"

#include <gtest/gtest.h>

#include <limits>

#include "force_term_checks.h"
#include "risorius/core/error.h"
#include "risorius/tissue/drag.h"
#include "risorius/tissue/gravity.h"

namespace risorius::tissue {
namespace {

using namespace testing_of;

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

GridSolid cube() {
    GridSolid solid;
    solid.grid = {3, 2, 4};
    solid.rest = block_rest(solid.grid, Vec3(3, 3, 3));
    solid.material = {isotropic_material(1.5, 0.1, 10, 4, 0.2)};
    return solid;
}

/// The message of check(), or nothing.
std::string complaint(const GridSolid& solid) {
    try {
        check(solid, "cube.json:/solid");
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(SolidMaterial, AGoodBodyIsTaken) {
    EXPECT_EQ(complaint(cube()), "");
    GridSolid solid = cube();
    solid.material.assign(24, solid.material[0]);
    EXPECT_EQ(complaint(solid), "");
}

TEST(SolidMaterial, AGridHasTwoNodesAlongEveryAxis) {
    GridSolid solid = cube();
    solid.grid.n = 1;
    EXPECT_EQ(complaint(solid), "cube.json:/solid/grid/n: expected at least 2 nodes, found 1");
    solid.grid = {0, 2, 2};
    EXPECT_EQ(complaint(solid), "cube.json:/solid/grid/m: expected at least 2 nodes, found 0");
}

TEST(SolidMaterial, WrongCountsAreNamed) {
    GridSolid solid = cube();
    solid.rest.conservativeResize(23, 3);
    EXPECT_EQ(complaint(solid), "cube.json:/solid/rest: expected 3 x 2 x 4 = 24 points, found 23");
    solid = cube();
    solid.material.assign(5, solid.material[0]);
    EXPECT_EQ(complaint(solid),
              "cube.json:/solid/material: expected 1 material or 3 x 2 x 4 = 24, one per node, "
              "found 5");
    solid.material.clear();
    EXPECT_EQ(complaint(solid),
              "cube.json:/solid/material: expected 1 material or 3 x 2 x 4 = 24, one per node, "
              "found 0");
}

TEST(SolidMaterial, RestHasToBeFiniteAndUnfolded) {
    GridSolid solid = cube();
    solid.rest(7, 1) = kNotANumber;
    EXPECT_EQ(complaint(solid),
              "cube.json:/solid/rest/7: expected three finite numbers, found [0, nan, 3]");
    solid = cube();
    solid.rest.col(0) *= -1;  // left-handed
    EXPECT_EQ(complaint(solid),
              "cube.json:/solid/rest: expected a shape that is nowhere folded, with a positive "
              "volume in each corner of every cell, found -4.5 m^3 in cell [0, 0, 0]");
    solid = cube();
    solid.rest(solid.grid.index(1, 0, 3), 2) = 0.5;  // below the node under it, which is at 2
    EXPECT_EQ(complaint(solid),
              "cube.json:/solid/rest: expected a shape that is nowhere folded, with a positive "
              "volume in each corner of every cell, found -6.75 m^3 in cell [0, 0, 2]");
    solid = cube();
    solid.rest.col(2).setZero();  // flat
    EXPECT_NE(complaint(solid).find("found 0 m^3"), std::string::npos);
}

TEST(SolidMaterial, BadMaterialsNameTheirField) {
    const std::string at = "cube.json:/solid/material/";
    const auto with = [](const auto& change) {
        GridSolid solid = cube();
        change(solid.material[0]);
        return complaint(solid);
    };
    EXPECT_EQ(with([](SolidMaterial& m) { m.mass_kg = 0; }),
              at + "mass_kg: expected (0, inf), found 0");
    EXPECT_EQ(with([](SolidMaterial& m) { m.mass_kg = -4; }),
              at + "mass_kg: expected (0, inf), found -4");
    EXPECT_EQ(with([](SolidMaterial& m) { m.drag_ns_per_m = kNotANumber; }),
              at + "drag_ns_per_m: expected [0, inf), found nan");
    EXPECT_EQ(with([](SolidMaterial& m) { m.incompressibility_n_per_m5 = -1; }),
              at + "incompressibility_n_per_m5: expected [0, inf), found -1");
    EXPECT_EQ(with([](SolidMaterial& m) { m.elastic_n_per_m3(1, 2) = -0.5; }),
              at + "elastic_n_per_m3/1/2: expected [0, inf), found -0.5");
    EXPECT_EQ(with([](SolidMaterial& m) {
                  m.damping_ns_per_m3(2, 2) = std::numeric_limits<double>::infinity();
              }),
              at + "damping_ns_per_m3/2/2: expected [0, inf), found inf");
    EXPECT_EQ(with([](SolidMaterial& m) { m.elastic_n_per_m3(0, 1) = 2; }),
              at + "elastic_n_per_m3/1/0: expected what stands at 0/1, 2, since the tensor is "
                   "symmetric, found 1.5");

    GridSolid solid = cube();
    solid.material.assign(24, solid.material[0]);
    solid.material[17].mass_kg = kNotANumber;
    EXPECT_EQ(complaint(solid), at + "17/mass_kg: expected (0, inf), found nan");
}

TEST(SolidMaterial, PerNodeTensorIsEquationTen) {
    // lambda = 1.5 on 3^3: 1.5 / (2 * 3 * 3)
    EXPECT_DOUBLE_EQ(per_node_tensor(Mat3::Constant(1.5), {3, 3, 3})(0, 0), 1.5 / 18);
    EXPECT_DOUBLE_EQ(per_node_tensor(Mat3::Constant(1.5), {3, 3, 3})(0, 1), 1.5 / 18);

    const GridShape grid{4, 3, 6};
    Mat3 lambda = Vec3(2, 3, 5).asDiagonal();
    lambda(0, 1) = lambda(1, 0) = 7;
    const Mat3 eta = per_node_tensor(lambda, grid);
    EXPECT_DOUBLE_EQ(eta(0, 0), 2.0 / (3 * 3 * 6));
    EXPECT_DOUBLE_EQ(eta(1, 1), 3.0 / (4 * 2 * 6));
    EXPECT_DOUBLE_EQ(eta(2, 2), 5.0 / (4 * 3 * 5));
    EXPECT_DOUBLE_EQ(eta(0, 1), 7.0 * (1.0 / 54 + 1.0 / 48) / 2);
    EXPECT_EQ(eta(0, 1), eta(1, 0));
}

TEST(SolidMaterial, NodesShareTheMassAndHaveTheDragEach) {
    GridSolid solid = cube();
    EXPECT_DOUBLE_EQ(node_mass(solid).sum(), 4.0);
    EXPECT_EQ(node_drag(solid)[5], 0.2);
    solid.material.assign(24, solid.material[0]);
    solid.material[3].mass_kg = 8;
    EXPECT_DOUBLE_EQ(node_mass(solid)[3], 2 * node_mass(solid)[4]);
}

TEST(Gravity, PullsEveryNodeByItsMass) {
    const Points x = random_points(4, 1.0, 1), still = Points::Zero(4, 3);
    const Gravity gravity(Eigen::Vector4d(1, 2, 3, 4), Vec3(0.5, 0, -9.81));
    const Points force = force_of(gravity, x, still);
    for (int i = 0; i < 4; ++i)
        EXPECT_EQ(Vec3(force.row(i).transpose()), (i + 1) * Vec3(0.5, 0, -9.81));
    expect_force_is_minus_slope_of_energy(gravity, 0, x, 1e-3, 1e-12);
    expect_gradient_of_potential(gravity, {.end_s = 0, .step_s = 0.1, .start = x}, x, 1e-3, 1e-12);
}

TEST(Drag, BrakesEveryNodeByItsCoefficient) {
    const Points start = random_points(3, 1.0, 2), x = random_points(3, 1.0, 3);
    const Drag drag(Eigen::Vector3d(0.1, 0, 2));
    const solve::ImplicitStep step{.end_s = 0, .step_s = 0.05, .start = start};
    const Points v = (x - start) / 0.05;
    const Points force = force_of(drag, x, v);
    EXPECT_EQ(Vec3(force.row(2).transpose()), Vec3(-2 * v.row(2).transpose()));
    EXPECT_EQ(force.row(1).cwiseAbs().maxCoeff(), 0.0);
    EXPECT_LT((potential_gradient(drag, step, x) + force).cwiseAbs().maxCoeff(), 1e-12);
    expect_gradient_of_potential(drag, step, x, 1e-4, 1e-9);
    expect_hessian_of_potential(drag, step, x, 1e-4, 1e-9);

    // Nothing moves in an equilibrium.
    const solve::ImplicitStep equilibrium{
        .end_s = 0, .step_s = std::numeric_limits<double>::infinity(), .start = start};
    EXPECT_EQ(potential_gradient(drag, equilibrium, x).cwiseAbs().maxCoeff(), 0.0);

    solve::MetricBuilder K(3), damping(3);
    Points rest_of_it = Points::Zero(3, 3);
    drag.add_secant(0, x, v, /*lag_rate=*/false, K, damping, rest_of_it);
    EXPECT_EQ(Eigen::MatrixXd(damping.build({})).diagonal(), Eigen::Vector3d(0.1, 0, 2));
    EXPECT_EQ(rest_of_it.cwiseAbs().maxCoeff(), 0.0);
}

}  // namespace
}  // namespace risorius::tissue
