// SPDX-License-Identifier: MIT
// Stiffness along fibres: closed forms of shear and stretch, derivatives, and the moduli of the whole material.
#include "risorius/tissue/along_fibres.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "force_term_checks.h"
#include "risorius/tissue/cell_solid.h"
#include "tet_blocks.h"

namespace risorius::tissue {
namespace {

constexpr double kNoStep = std::numeric_limits<double>::infinity();
constexpr double kAcross_pa = 1930, kAlong_pa = 5770;  // PMC8754054

const Vec3 kMuscleBlock(0.03, 0.02, 0.01);

/// A block of cells that is bent_block, so that the directions differ.
Vec3 bent_block(const Vec3& a) {
    const double turn = 0.6 * a[0], radius = 0.05 + kMuscleBlock[2] * a[2];
    return {radius * std::sin(turn), kMuscleBlock[1] * a[1], radius * std::cos(turn)};
}

Points rest_nodes(const CellMesh& mesh, const std::function<Vec3(const Vec3&)>& at) {
    Points out(mesh.node_count(), 3);
    for (Eigen::Index i = 0; i < out.rows(); ++i)
        out.row(i) = at(mesh.material_coordinates().row(i).transpose()).transpose();
    return out;
}

double stored_j(const solve::EnergyTerm& term, const Points& x) {
    Points gradient = Points::Zero(x.rows(), 3);
    return term.add_potential({0, kNoStep, x}, x, gradient);
}

Points strained(const Points& rest, const Mat3& f) { return rest * f.transpose(); }

// C a = (1, g, 0) + g^2 a in the plane of the fibres: s/2 g^2 for a shear across them as for one along them, and nothing for one about them.
TEST(AlongFibres, ResistSimpleShearAsInTheClosedForm) {
    const auto block = testing_of::tet_block({3, 2, 2}, kMuscleBlock);
    const AlongFibres term(strain_points(block.tets, block.rest,
                                         Vec3::UnitX().transpose().replicate(block.tets.rows(), 1)),
                           {.shear_pa = 4000, .stretch_pa = 0});
    const double volume = kMuscleBlock.prod();
    for (const double g : {-0.4, 0.1, 0.3}) {
        Mat3 along = Mat3::Identity(), across = along, about = along;
        along(0, 1) = g;   // layers slide along the fibres
        across(1, 0) = g;  // sections slide past each other
        about(1, 2) = g;
        EXPECT_NEAR(stored_j(term, strained(block.rest, along)), volume * 2000 * g * g, 1e-12);
        EXPECT_NEAR(stored_j(term, strained(block.rest, across)), volume * 2000 * g * g, 1e-12);
        EXPECT_NEAR(stored_j(term, strained(block.rest, about)), 0, 1e-15);
    }
    Mat3 longer = Mat3::Identity();
    longer(0, 0) = 1.3;
    EXPECT_NEAR(stored_j(term, strained(block.rest, longer)), 0, 1e-15);
}

// Stress k (l - 1) per area at rest, and nothing in fibres that are shortened.
TEST(AlongFibres, ResistStretchAsInTheClosedForm) {
    const auto block = testing_of::tet_block({3, 2, 2}, kMuscleBlock);
    const AlongFibres term(strain_points(block.tets, block.rest,
                                         Vec3::UnitX().transpose().replicate(block.tets.rows(), 1)),
                           {.shear_pa = 4000, .stretch_pa = 36000});
    for (const double l : {0.8, 0.99, 1.01, 1.1, 1.3, 1.6}) {
        const Points x = strained(block.rest, Vec3(l, 1.1, 0.9).asDiagonal());
        Points gradient = Points::Zero(x.rows(), 3);
        term.add_potential({0, kNoStep, x}, x, gradient);
        double pull = 0;
        for (Eigen::Index i = 0; i < x.rows(); ++i)
            if (block.rest(i, 0) == kMuscleBlock[0]) pull += gradient(i, 0);
        EXPECT_NEAR(pull, kMuscleBlock[1] * kMuscleBlock[2] * 36000 * std::max(l - 1, 0.0), 1e-9);
        const Mat3 f = Vec3(l, 1.1, 0.9).asDiagonal();
        const Mat3 stress = AlongFibres::cauchy_stress_pa(term.moduli(), f, Vec3::UnitX());
        EXPECT_NEAR(stress(0, 0), pull / (kMuscleBlock[1] * kMuscleBlock[2] * 1.1 * 0.9), 1e-6);
    }
}

TEST(AlongFibres, DoNothingWhenTheSolidTurns) {
    const CellMesh mesh = uniform_cells({4, 3, 3});
    const Points rest = rest_nodes(mesh, bent_block);
    const AlongFibres term(strain_points(mesh, rest), {.shear_pa = 4000, .stretch_pa = 36000});
    const Mat3 turn = Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    EXPECT_NEAR(stored_j(term, strained(rest, turn)), 0, 1e-17);
}

TEST(AlongFibres, HaveTheDerivativesOfTheirEnergy) {
    const CellMesh mesh = uniform_cells({3, 2, 2});
    const Points rest = rest_nodes(mesh, bent_block);
    const AlongFibres term(strain_points(mesh, rest), {.shear_pa = 4000, .stretch_pa = 36000});
    const Points x = rest + testing_of::random_points(rest.rows(), 2e-3, 5);
    const solve::ImplicitStep step{0, kNoStep, rest};
    testing_of::expect_gradient_of_potential(term, step, x, 1e-7, 1e-6);
    testing_of::expect_hessian_of_potential(term, step, x, 1e-7, 1e-6);
    testing_of::expect_projection(term, step, x);
}

// The moduli of the whole material, from its second derivative at rest, K large against mu.
TEST(AlongFibres, GiveTheModuliOfRelaxedMuscle) {
    const CellMesh mesh = uniform_cells({2, 2, 2});
    const Points rest = rest_nodes(mesh, [](const Vec3& a) -> Vec3 { return a; });
    const double k = 27000;  // as rigs/standard/muscle_solids.json
    const CellSolid matrix(cell_body(
        mesh, [](const Vec3& a) -> Vec3 { return a; }, CellModuli{kAcross_pa, 1e9, 0}, 1000));
    const AlongFibres term(strain_points(mesh, rest),
                           {.shear_pa = kAlong_pa - kAcross_pa, .stretch_pa = k});
    const auto energy = [&](const Mat3& strain) {
        const Points x = strained(rest, Mat3::Identity() + strain);
        return stored_j(matrix, x) + stored_j(term, x);
    };
    const auto shear_modulus = [&](int i, int j) {
        Mat3 strain = Mat3::Zero();
        strain(i, j) = 1e-4;
        return 2 * energy(strain) / 1e-8;
    };
    EXPECT_NEAR(shear_modulus(0, 1) / kAlong_pa, 1, 1e-5);
    EXPECT_NEAR(shear_modulus(1, 0) / kAlong_pa, 1, 1e-5);
    EXPECT_NEAR(shear_modulus(1, 2) / kAcross_pa, 1, 1e-5);
    // Stretched along an axis, with the widths of least energy
    const auto young = [&](int axis) {
        double least = 1e300;
        const double e = 1e-4;
        for (double share = 0; share <= 1; share += 1e-4) {
            Mat3 strain = Mat3::Zero();
            strain(axis, axis) = e;
            const int next = (axis + 1) % 3, last = (axis + 2) % 3;
            strain(next, next) = -share * e;
            strain(last, last) = 1 / ((1 + e) * (1 - share * e)) - 1;
            least = std::min(least, energy(strain));
        }
        return 2 * least / (e * e);
    };
    const double expected_along = 3 * kAcross_pa + k;
    EXPECT_NEAR(young(0) / expected_along, 1, 1e-3);
    EXPECT_NEAR(young(1) / (3 * kAcross_pa), 1, 1e-3) << "fibres are shortened";
    EXPECT_NEAR(young(0) / young(1) - 1, 4.67, 0.01) << "the tensile anisotropy of PMC8754054";
}

TEST(AlongFibres, RefuseModuliBelowZero) {
    EXPECT_THROW(AlongFibres({}, {.shear_pa = -1, .stretch_pa = 0}), std::invalid_argument);
    EXPECT_THROW(AlongFibres({}, {.shear_pa = 0, .stretch_pa = -1}), std::invalid_argument);
}

}  // namespace
}  // namespace risorius::tissue
