// SPDX-License-Identifier: MIT
// Cells that bend: the laws of their energy, and bars and plates in closed form.
#include "risorius/tissue/bending_cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "force_term_checks.h"
#include "risorius/core/dense_algebra.h"
#include "risorius/tissue/cell_solid.h"
#include "risorius/tissue/moduli.h"

namespace risorius::tissue {
namespace {

CellModuli rubber(double poisson_ratio) {
    const IsotropicModuli of = moduli_of_young(1000, poisson_ratio);
    return {.mu_pa = of.shear_pa, .bulk_pa = of.volume_pa, .viscosity_pa_s = 0};
}

/// A turned block of m x n x o cells, not cubes.
CellBody block(const GridShape& grid, const Vec3& size, const CellModuli& moduli) {
    const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()).toRotationMatrix();
    return cell_body(
        uniform_cells(grid),
        [&](const Vec3& at) -> Vec3 { return turn * size.cwiseProduct(at) + Vec3(1, -2, 3); },
        moduli, 1);
}

const Points kNowhere = Points::Zero(0, 3);
double energy_of(const solve::EnergyTerm& term, const Points& x) { return term.energy(0, x); }

// A homogeneous deformation has the energy of the usual cells: nothing varies in a cell.
TEST(BendingCellLaws, HomogeneousStrainIsThatOfTheUsualCells) {
    const CellBody body = block({3, 4, 3}, {0.3, 0.2, 0.5}, rubber(0.4));
    const BendingCells bending(body);
    const CellSolid usual(body);
    Mat3 f;
    f << 1.2, 0.1, -0.2, 0.05, 0.9, 0.1, -0.1, 0.2, 1.1;
    const Points x = body.rest * f.transpose();
    EXPECT_NEAR(energy_of(bending, x), energy_of(usual, x), 1e-12 * energy_of(usual, x));
    EXPECT_LT((testing_of::force_of(bending, x, kNowhere) -
               testing_of::force_of(usual, x, Points::Zero(x.rows(), 3)))
                  .norm(),
              1e-10 * testing_of::force_of(bending, x, kNowhere).norm());
}

TEST(BendingCellLaws, RotationCostsNothing) {
    const CellBody body = block({3, 3, 2}, {0.3, 0.2, 0.5}, rubber(0.49));
    const BendingCells bending(body);
    const Mat3 turn = Eigen::AngleAxisd(1.3, Vec3(-1, 1, 2).normalized()).toRotationMatrix();
    EXPECT_NEAR(energy_of(bending, body.rest * turn.transpose()), 0, 1e-20);
    EXPECT_NEAR(energy_of(bending, body.rest), 0, 1e-25);
}

TEST(BendingCellLaws, GradientAndCurvatureAreThoseOfTheEnergy) {
    const CellBody body = block({3, 2, 3}, {0.3, 0.2, 0.5}, rubber(0.45));
    const BendingCells bending(body);
    const Points x = body.rest + testing_of::random_points(body.rest.rows(), 0.03, 5);
    const solve::ImplicitStep step{0, std::numeric_limits<double>::infinity(), x};
    testing_of::expect_gradient_of_potential(bending, step, x, 1e-6, 1e-7);
    const Eigen::MatrixXd exact = testing_of::hessian(bending, step, x, solve::Curvature::kExact);
    Points moved = x;
    for (long column = 0; column < exact.cols(); column += 5) {
        double& at = moved(column / 3, column % 3);
        const double before = at;
        at = before + 1e-6;
        const Points up = testing_of::potential_gradient(bending, step, moved);
        at = before - 1e-6;
        const Points down = testing_of::potential_gradient(bending, step, moved);
        at = before;
        for (long r = 0; r < exact.rows(); ++r)
            EXPECT_NEAR(exact(r, column), (up(r / 3, r % 3) - down(r / 3, r % 3)) / 2e-6,
                        1e-7 * exact.cwiseAbs().maxCoeff());
    }
    const Eigen::MatrixXd positive =
        testing_of::hessian(bending, step, x, solve::Curvature::kPositive);
    EXPECT_GT(symmetric_eigenvalues(positive).minCoeff(), -1e-9 * exact.cwiseAbs().maxCoeff());
    // No motion but those of a rigid body is free at rest.
    const solve::ImplicitStep still{0, std::numeric_limits<double>::infinity(), body.rest};
    const Eigen::VectorXd at_rest = symmetric_eigenvalues(
        testing_of::hessian(bending, still, body.rest, solve::Curvature::kExact));
    EXPECT_LT(at_rest.head(6).cwiseAbs().maxCoeff(), 1e-9 * at_rest.maxCoeff());
    EXPECT_GT(at_rest[6], 1e-4 * at_rest.maxCoeff());
}

/// The energy of one cell of edges a, b, h whose sections turn: u1 = r x z, u3 = -r x^2 / 2 (left to the nodes), and along y likewise.
double bent_energy(const CellModuli& moduli, double along_x, double along_y) {
    const Vec3 edges(0.2, 0.3, 0.1);
    const CellBody body = cell_body(
        uniform_cells({2, 2, 2}), [&](const Vec3& at) -> Vec3 { return edges.cwiseProduct(at); },
        moduli, 1);
    Points x = body.rest;
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
        const Vec3 at = body.rest.row(i).transpose() - 0.5 * edges;
        x(i, 0) += along_x * at.x() * at.z();
        x(i, 1) += along_y * at.y() * at.z();
    }
    return energy_of(BendingCells(body), x);
}

// A plate: D / 2 (k1^2 + k2^2 + 2 nu k1 k2) a b with D = E h^3 / (12 (1 - nu^2)), exact with one cell. A bar that may curve across has
// E I / 2 k^2: its least energy over the curvature across.
TEST(BendingCellLaws, OneCellBendsAsAPlateAndABar) {
    for (const double nu : {0.0, 0.3, 0.49, 0.499}) {
        const double h = 0.1, area = 0.06, stiffness = 1000 * h * h * h / (12 * (1 - nu * nu)),
                     k = 1e-3;
        const auto plate = [&](double k1, double k2) {
            return 0.5 * stiffness * area * (k1 * k1 + k2 * k2 + 2 * nu * k1 * k2);
        };
        for (const auto& [k1, k2] : {std::pair{k, 0.0}, {0.0, k}, {k, k}, {k, -nu * k}})
            EXPECT_NEAR(bent_energy(rubber(nu), k1, k2), plate(k1, k2), 1e-6 * plate(k, k)) << nu;
        EXPECT_NEAR(bent_energy(rubber(nu), k, -nu * k),
                    0.5 * 1000 * 0.3 * h * h * h / 12 * k * k * 0.2, 1e-6 * plate(k, k));
    }
}

TEST(BendingCellLaws, RefuseWhatIsNoBoxAndWhatHasViscosity) {
    const auto complaint = [](CellBody body) {
        try {
            const BendingCells refused(std::move(body));
        } catch (const std::invalid_argument& error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    CellBody skew = block({3, 3, 3}, {0.3, 0.2, 0.5}, rubber(0.4));
    skew.rest(13, 0) += 1e-3;
    EXPECT_EQ(complaint(skew), "BendingCells: cell 0 is no box");
    CellModuli viscous = rubber(0.3);
    viscous.viscosity_pa_s = 1;
    EXPECT_EQ(complaint(block({2, 2, 2}, {1, 1, 1}, viscous)),
              "BendingCells: moduli without viscosity are needed");
}

}  // namespace
}  // namespace risorius::tissue
