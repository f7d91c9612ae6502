// SPDX-License-Identifier: MIT
// Hyperelastic materials against their closed forms, and derivatives against differences.
#include "risorius/tissue/hyperelastic.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "force_term_checks.h"
#include "risorius/core/dense_algebra.h"
#include "risorius/solve/integrator.h"
#include "risorius/solve/motion_system.h"
#include "risorius/tissue/hyperelastic_tets.h"

namespace risorius::tissue {
namespace {

const Hyperelastic kNeoHookean{.c10_pa = 400, .bulk_pa = 8e4};
const Hyperelastic kMooneyRivlin{.c10_pa = 300, .c01_pa = 120, .bulk_pa = 6e4};
// Treloar's rubber, of Ogden 1972, in kPa instead of kg/cm^2: exponents 1.3, 5.0, -2.0
const Hyperelastic kOgden{.ogden = {{630, 1.3}, {1.2, 5.0}, {-10, -2.0}}, .bulk_pa = 9e4};
// Shape of Blemker's muscle: P1 = 0.05, P2 = 6.6, l* = 1.4
const Hyperelastic kMuscle{.c10_pa = 500,
                           .bulk_pa = 1e5,
                           .fibres = {.c3_pa = 150, .c4 = 6.6, .c5_pa = 1.5e4, .straight = 1.4}};
const Vec3 kAlong = Vec3(0.48, 0.6, 0.64);

Mat3 uniaxial(double stretch, const Vec3& axis = Vec3::UnitX()) {
    const double across = 1 / std::sqrt(stretch);
    return across * Mat3::Identity() + (stretch - across) * axis * axis.transpose();
}

/// Difference of the stresses along x and y: the pressure drops out, so that incompressible forms are exact at J = 1.
double tension(const Hyperelastic& material, double stretch) {
    const Mat3 stress = cauchy_stress_pa(material, uniaxial(stretch), Vec3::UnitX());
    EXPECT_NEAR(stress(1, 1), stress(2, 2), 1e-9);
    return stress(0, 0) - stress(1, 1);
}

TEST(HyperelasticLaws, UniaxialTensionOfMooneyAndRivlin) {
    for (const Hyperelastic* material : {&kNeoHookean, &kMooneyRivlin})
        for (const double l : {0.4, 0.8, 1.0, 1.3, 2.5})
            EXPECT_NEAR(tension(*material, l),
                        2 * (l * l - 1 / l) * (material->c10_pa + material->c01_pa / l), 1e-8);
}

TEST(HyperelasticLaws, UniaxialTensionOfOgden) {
    for (const double l : {0.5, 1.0, 1.7, 3.0}) {
        double expected = 0;
        for (const OgdenTerm& term : kOgden.ogden)
            expected +=
                term.modulus_pa * (std::pow(l, term.exponent) - std::pow(l, -0.5 * term.exponent));
        EXPECT_NEAR(tension(kOgden, l), expected, 1e-8);
    }
}

// Exponents 2 and -2 are Mooney and Rivlin's law.
TEST(HyperelasticLaws, OgdenWithTwoExponentsIsMooneyRivlin) {
    const Hyperelastic ogden{.ogden = {{600, 2}, {-240, -2}}, .bulk_pa = 6e4};
    for (unsigned seed = 1; seed < 6; ++seed) {
        const Mat3 f = Mat3::Identity() + testing_of::random_points(3, 0.3, seed);
        ASSERT_GT(f.determinant(), 0);
        const Response one = response(ogden, f, kAlong), other = response(kMooneyRivlin, f, kAlong);
        EXPECT_NEAR(one.energy_pa, other.energy_pa, 1e-9 * std::abs(other.energy_pa) + 1e-9);
        EXPECT_TRUE(one.stress_pa.isApprox(other.stress_pa, 1e-11));
    }
}

// Simple shear: s12 = 2 (c10 + c01) g, s11 - s22 = 2 (c10 + c01) g^2, s11 - s33 = 2 c10 g^2
TEST(HyperelasticLaws, SimpleShearOfMooneyAndRivlin) {
    for (const double g : {0.1, 0.7, 2.0}) {
        Mat3 f = Mat3::Identity();
        f(0, 1) = g;
        const Mat3 stress = cauchy_stress_pa(kMooneyRivlin, f, kAlong);
        EXPECT_NEAR(stress(0, 1), 2 * 420 * g, 1e-8);
        EXPECT_NEAR(stress(0, 0) - stress(1, 1), 2 * 420 * g * g, 1e-8);
        EXPECT_NEAR(stress(0, 0) - stress(2, 2), 2 * 300 * g * g, 1e-8);
        EXPECT_NEAR(stress(1, 2), 0, 1e-8);
    }
}

TEST(HyperelasticLaws, PressureIsThatOfTheBulkModulus) {
    for (const Hyperelastic* material : {&kNeoHookean, &kMooneyRivlin, &kOgden, &kMuscle}) {
        const Mat3 f = 1.1 * Mat3::Identity();
        const double pressure = material->bulk_pa * (f.determinant() - 1);
        EXPECT_TRUE(
            cauchy_stress_pa(*material, f, kAlong).isApprox(pressure * Mat3::Identity(), 1e-10));
    }
}

// Fibres add c3 (exp(c4 (l - 1)) - 1), then c5 l + c6, to the tension along them, and nothing when they are shortened.
TEST(HyperelasticLaws, FibresPullAsWeissSays) {
    const Hyperelastic without{.c10_pa = kMuscle.c10_pa, .bulk_pa = kMuscle.bulk_pa};
    for (const double l : {0.6, 1.0, 1.2, 1.39, 1.6}) {
        const double end = std::min(l, 1.4);
        double expected = l <= 1 ? 0 : 150 * std::expm1(6.6 * (end - 1));
        if (l > 1.4) expected += 1.5e4 * (l - 1.4);
        EXPECT_NEAR(tension(kMuscle, l) - tension(without, l), expected, 1e-7 * (1 + expected))
            << l;
    }
    // Along any direction, and not across it
    const Mat3 stress = cauchy_stress_pa(kMuscle, uniaxial(1.3, kAlong), kAlong);
    const Vec3 across = kAlong.cross(Vec3::UnitX()).normalized();
    EXPECT_NEAR(kAlong.dot(stress * kAlong) - across.dot(stress * across), tension(kMuscle, 1.3),
                1e-7);
}

TEST(HyperelasticLaws, ShearModulusAtRestIsTheSlopeOfShear) {
    for (const Hyperelastic* material : {&kNeoHookean, &kMooneyRivlin, &kOgden}) {
        Mat3 f = Mat3::Identity();
        f(0, 1) = 1e-6;
        EXPECT_NEAR(cauchy_stress_pa(*material, f, kAlong)(0, 1) / 1e-6, material->shear_pa(),
                    1e-5 * material->shear_pa());
    }
}

// Central differences with a step of 1e-6: errors of 1e-12 times third derivatives, and rounding of 1e-16 W / 1e-6.
TEST(HyperelasticDerivatives, StressIsTheSlopeOfTheEnergyAndStiffnessThatOfTheStress) {
    constexpr double kChange = 1e-6;
    for (const Hyperelastic* material : {&kNeoHookean, &kMooneyRivlin, &kOgden, &kMuscle})
        for (unsigned seed = 0; seed < 8; ++seed) {
            // The rest shape, equal stretches, and others
            const Mat3 f = seed == 0 ? Mat3(Mat3::Identity())
                           : seed == 1
                               ? uniaxial(1.25)
                               : Mat3(Mat3::Identity() + testing_of::random_points(3, 0.25, seed));
            const Stiffness exact = stiffness(*material, f, kAlong);
            EXPECT_TRUE(exact.isApprox(exact.transpose(), 1e-9));
            const double scale = exact.cwiseAbs().maxCoeff();
            if (seed == 0 && material == &kMuscle) continue;  // fibres begin to pull: a kink
            for (int c = 0; c < 9; ++c) {
                Mat3 above = f, below = f;
                above(c % 3, c / 3) += kChange;
                below(c % 3, c / 3) -= kChange;
                const Response up = response(*material, above, kAlong),
                               down = response(*material, below, kAlong);
                EXPECT_NEAR(response(*material, f, kAlong).stress_pa(c % 3, c / 3),
                            (up.energy_pa - down.energy_pa) / (2 * kChange), 1e-7 * scale);
                const Mat3 slope = (up.stress_pa - down.stress_pa) / (2 * kChange);
                for (int r = 0; r < 9; ++r)
                    EXPECT_NEAR(exact(r, c), slope(r % 3, r / 3), 1e-6 * scale) << r << " " << c;
            }
        }
}

/// A cube of 2^3 cells, each of six tetrahedra, with its middle node moved.
HyperelasticBody cube(const Hyperelastic& material) {
    HyperelasticBody body;
    body.rest.resize(27, 3);
    const auto index = [](int i, int j, int k) { return (i * 3 + j) * 3 + k; };
    for (int i = 0; i < 27; ++i) body.rest.row(i) << i / 9 * 0.05, i / 3 % 3 * 0.05, i % 3 * 0.05;
    body.rest.row(13) += Eigen::RowVector3d(0.008, -0.005, 0.003);
    body.tets.resize(48, 4);
    const int paths[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    int t = 0;
    for (int cell = 0; cell < 8; ++cell)
        for (const auto& path : paths) {
            int at[3] = {cell >> 2 & 1, cell >> 1 & 1, cell & 1};
            body.tets(t, 0) = index(at[0], at[1], at[2]);
            for (int step = 0; step < 3; ++step) {
                ++at[path[step]];
                body.tets(t, step + 1) = index(at[0], at[1], at[2]);
            }
            const bool odd = &path - paths >= 3;
            if (odd) std::swap(body.tets(t, 2), body.tets(t, 3));
            ++t;
        }
    body.materials = {material};
    body.material_of.assign(48, 0);
    body.fibres = kAlong.transpose().replicate(48, 1);
    return body;
}

TEST(HyperelasticBodies, GradientAndCurvatureAreThoseOfTheEnergy) {
    for (const Hyperelastic* material : {&kMooneyRivlin, &kOgden, &kMuscle}) {
        const HyperelasticTets term(cube(*material));
        const Points x = term.body().rest + testing_of::random_points(27, 0.004, 3);
        const solve::ImplicitStep step{0, std::numeric_limits<double>::infinity(), x};
        testing_of::expect_gradient_of_potential(term, step, x, 1e-7, 1e-6);
        const Eigen::MatrixXd exact = testing_of::hessian(term, step, x, solve::Curvature::kExact);
        Points moved = x;
        for (long c = 0; c < 81; c += 7) {
            moved(c / 3, c % 3) = x(c / 3, c % 3) + 1e-7;
            const Points up = testing_of::potential_gradient(term, step, moved);
            moved(c / 3, c % 3) = x(c / 3, c % 3) - 1e-7;
            const Points down = testing_of::potential_gradient(term, step, moved);
            moved(c / 3, c % 3) = x(c / 3, c % 3);
            for (long r = 0; r < 81; ++r)
                EXPECT_NEAR(exact(r, c), (up(r / 3, r % 3) - down(r / 3, r % 3)) / 2e-7,
                            1e-5 * exact.cwiseAbs().maxCoeff());
        }
        const Eigen::MatrixXd positive =
            testing_of::hessian(term, step, x, solve::Curvature::kPositive);
        EXPECT_GT(symmetric_eigenvalues(positive).minCoeff(), -1e-9 * exact.cwiseAbs().maxCoeff());
    }
}

// Patch test: with its boundary moved by F, the inner node goes to F X.
TEST(HyperelasticBodies, InnerNodeGoesWhereTheBoundarySays) {
    Mat3 f;
    f << 1.3, 0.2, 0, -0.1, 0.9, 0.15, 0.05, 0, 0.95;
    for (const Hyperelastic* material : {&kNeoHookean, &kMooneyRivlin, &kOgden, &kMuscle}) {
        auto term = std::make_shared<HyperelasticTets>(cube(*material));
        std::vector<char> fixed(27, 1);
        fixed[13] = 0;
        solve::MotionSystem system(Eigen::VectorXd::Constant(27, 0.01), fixed);
        system.add(term);
        const Points goal = term->body().rest * f.transpose();
        solve::MotionState state{0, goal, Points::Zero(27, 3)};
        state.x.row(13) += Eigen::RowVector3d(0.005, 0.004, -0.003);
        solve::make_integrator({.method = solve::Method::kQuasiStatic,
                                .length_scale_m = 0.1,
                                .newton_tolerance = 1e-12})
            ->advance(system, state, 1);
        EXPECT_LT((state.x - goal).norm(), 1e-9);
        EXPECT_NEAR(term->volume(state.x), 0.001 * f.determinant(), 1e-12);
    }
}

}  // namespace
}  // namespace risorius::tissue
