// SPDX-License-Identifier: MIT
// Fibres in tetrahedra: the closed form of a prism, the same as fibres of a grid, and derivatives.
#include "risorius/muscle/fibre_tets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "force_term_checks.h"
#include "risorius/muscle/musculotendon.h"
#include "tet_blocks.h"

namespace risorius::muscle {
namespace {

using testing_of::TetBlock;

const Vec3 kPrism(0.04, 0.01, 0.02);
constexpr double kSection_m2 = 2e-4, kTension_pa = 3e5;

FibreTets fibres_along(const TetBlock& block, const Vec3& along, double activation,
                       FibreTetsParameters parameters = {}) {
    parameters.tension_pa = kTension_pa;
    return {parameters, block.rest, block.tets, along.transpose().replicate(block.tets.rows(), 1),
            [activation](double) { return activation; }};
}

/// The force with which the nodes of the end x = 0 pull inward, N.
double pull_of_end(const FibreTets& fibres, const TetBlock& block, const Points& x,
                   const Points& v) {
    Points force = Points::Zero(x.rows(), 3);
    fibres.add_force(0, x, v, force);
    double pull = 0;
    for (Eigen::Index i = 0; i < x.rows(); ++i)
        if (block.rest(i, 0) == 0) pull += force(i, 0);
    return pull;
}

// Specific tension x area at rest x (activation x fl + fp), however wide the prism is.
TEST(FibreTets, PullAsTheClosedFormOfAPrism) {
    const TetBlock block = testing_of::tet_block({4, 2, 3}, kPrism);
    const MuscleCurves curves = zajac_curves();
    const Points still = Points::Zero(block.rest.rows(), 3);
    for (const double l : {0.55, 0.8, 1.0, 1.15, 1.3})
        for (const double l0 : {1.0, 1.2})
            for (const double a : {0.0, 0.3, 1.0}) {
                const FibreTets fibres =
                    fibres_along(block, Vec3::UnitX(), a, {.optimal_stretch = l0});
                const Points x = block.rest * Vec3(l, 1.1, 0.7).asDiagonal().toDenseMatrix();
                const double expected =
                    kTension_pa * kSection_m2 *
                    (a * curves.active.value(l / l0) + curves.passive.value(l / l0));
                EXPECT_NEAR(pull_of_end(fibres, block, x, still), expected, 1e-9) << l << " " << a;
                EXPECT_NEAR(fibres.mean_stretch(x), l / l0, 1e-12);
            }
}

// Hill's relation: the prism shortens at a constant speed.
TEST(FibreTets, PullLessWhileTheyShorten) {
    const TetBlock block = testing_of::tet_block({4, 1, 1}, kPrism);
    const MuscleCurves curves = zajac_curves();
    for (const double speed : {-0.5, -0.1, 0.0, 0.2}) {
        const FibreTets fibres = fibres_along(block, Vec3::UnitX(), 1, {.damping = 0.1});
        Points v = Points::Zero(block.rest.rows(), 3);
        v.col(0) = 10 * speed * block.rest.col(0);
        const double expected =
            kTension_pa * kSection_m2 * (curves.velocity.value(speed) + 0.1 * speed);
        EXPECT_NEAR(pull_of_end(fibres, block, block.rest, v), expected, 1e-9);
        // A step that ends at rest with that speed has the same force.
        const double h = 1e-4;
        const Points start = block.rest - h * v;
        Points gradient = Points::Zero(v.rows(), 3);
        fibres.add_potential({0, h, start}, block.rest, gradient);
        double pull = 0;
        for (Eigen::Index i = 0; i < v.rows(); ++i)
            if (block.rest(i, 0) == 0) pull -= gradient(i, 0);
        // The active force is that of the start, at which the fibres are longer by h v.
        EXPECT_NEAR(pull, expected, 1e-3 * std::abs(expected));
    }
}

// A block of the same size with fibres along a grid: F0 is the specific tension times the area.
TEST(FibreTets, PullAsAMusculotendonOfTheSameSize) {
    const TetBlock block = testing_of::tet_block({4, 2, 2}, kPrism);
    const tissue::GridShape grid{5, 3, 3};
    const Points no_anchor(0, 3);
    const Musculotendon lines({.f0_n = kTension_pa * kSection_m2, .optimal_length_m = 0.04},
                              zajac_curves(), grid, block.rest, {}, [](double) { return 0.6; });
    const FibreTets fibres = fibres_along(block, Vec3::UnitX(), 0.6);
    for (const double l : {0.7, 1.2}) {
        const Points x = block.rest * Vec3(l, 1, 1).asDiagonal().toDenseMatrix();
        Points force = Points::Zero(x.rows(), 3);
        lines.add_force(0, x, Points::Zero(x.rows(), 3), force);
        const double expected = force.topRows(9).col(0).sum();
        EXPECT_NEAR(pull_of_end(fibres, block, x, Points::Zero(x.rows(), 3)), expected, 1e-9);
        EXPECT_NEAR(lines.energy(0, x) - lines.energy(0, block.rest),
                    fibres.energy(0, x) - fibres.energy(0, block.rest), 1e-12);
    }
}

TEST(FibreTets, HaveDerivativesOfTheirEnergy) {
    const TetBlock block = testing_of::tet_block({2, 1, 1}, kPrism);
    const FibreTets fibres = fibres_along(block, Vec3(2, 1, -1).normalized(), 0.7);
    const Points x = block.rest * Vec3(1.15, 0.9, 1).asDiagonal().toDenseMatrix() +
                     testing_of::random_points(block.rest.rows(), 5e-4, 3);
    const Points start = x + testing_of::random_points(block.rest.rows(), 2e-4, 4);
    testing_of::expect_force_is_minus_slope_of_energy(fibres, 0, x, 1e-8, 1e-6);
    for (const double h : {0.01, std::numeric_limits<double>::infinity()}) {
        const solve::ImplicitStep step{0, h, start};
        testing_of::expect_gradient_of_potential(fibres, step, x, 1e-8, 1e-6);
        testing_of::expect_hessian_of_potential(fibres, step, x, 1e-8, 1e-5);
        testing_of::expect_projection(fibres, step, x);
    }
}

// Half of the prism is longer and half shorter than the optimal length: each pulls with the tension at the mean length.
TEST(FibreTets, MayTakeTheirActiveTensionAtTheMeanLength) {
    const TetBlock block = testing_of::tet_block({4, 1, 1}, kPrism);
    const FibreTets fibres = fibres_along(block, Vec3::UnitX(), 0.6, {.active_by_mean = true});
    Points x = block.rest;
    for (Eigen::Index i = 0; i < x.rows(); ++i)
        x(i, 0) = 0.7 * std::min(x(i, 0), 0.02) + 1.1 * std::max(x(i, 0) - 0.02, 0.0);
    const MuscleCurves curves = zajac_curves();
    const Points still = Points::Zero(x.rows(), 3);
    EXPECT_NEAR(fibres.mean_stretch(x), 0.9, 1e-12);
    EXPECT_NEAR(pull_of_end(fibres, block, x, still),
                kTension_pa * kSection_m2 * 0.6 * curves.active.value(0.9), 1e-9);
    for (const FibreTets::State& state : fibres.states(0, x))
        EXPECT_NEAR(
            state.tension_pa,
            kTension_pa * (0.6 * curves.active.value(0.9) + curves.passive.value(state.stretch)),
            1e-6);
    Points moved = x + testing_of::random_points(x.rows(), 5e-4, 3);
    const double forever = std::numeric_limits<double>::infinity();
    for (const double h : {forever, 0.01}) {
        const solve::ImplicitStep step{0, h, x};
        testing_of::expect_gradient_of_potential(fibres, step, moved, 1e-8, 1e-5);
        testing_of::expect_hessian_of_potential(fibres, step, moved, 1e-8, 1e-5);
        testing_of::expect_projection(fibres, step, moved);
    }
}

TEST(FibreTets, RefuseWhatDoesNotFitTogether) {
    const TetBlock block = testing_of::tet_block({1, 1, 1}, kPrism);
    EXPECT_THROW(FibreTets({.tension_pa = 1}, block.rest, block.tets, Points(0, 3), {}),
                 std::invalid_argument);
    EXPECT_THROW(FibreTets({.tension_pa = 0}, block.rest, block.tets,
                           Points::Ones(block.tets.rows(), 3), {}),
                 std::invalid_argument);
    EXPECT_THROW(FibreTets({.tension_pa = 1}, Points::Zero(block.rest.rows(), 3), block.tets,
                           Points::Ones(block.tets.rows(), 3), {}),
                 std::invalid_argument);
}

}  // namespace
}  // namespace risorius::muscle
