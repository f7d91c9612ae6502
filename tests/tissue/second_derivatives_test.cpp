// SPDX-License-Identifier: MIT
// Second derivatives of the tissue of a face: tetrahedra, skin, zero-length springs, contacts.
#include "risorius/tissue/contacts.h"
#include "risorius/tissue/detail/principal_stretches.h"
#include "risorius/tissue/skin_sheet.h"
#include "risorius/tissue/tet_solid.h"
#include "risorius/tissue/zero_length_springs.h"
#include "second_derivative_checks.h"
#include "tissue/layered_block.h"

namespace risorius::tissue {
namespace {

using solve::Curvature;
using testing_of::dense_second;
using testing_of::expect_positive_part;
using testing_of::expect_slope_of_gradient;

constexpr double kStep_m = 1e-8;
constexpr double kTolerance = 1e-6;  // of differences

const LayeredBlock kSmall(3, 2, 2);

TEST(PrincipalStretches, PutTheGradientTogetherAgainAndCarryItsSign) {
    Mat3 turned_inside_out;
    turned_inside_out << 0.3, 1.2, -0.1, 0.8, 0.4, 0.2, 0.1, -0.3, 0.9;
    Mat3 crushed = Mat3::Zero();
    crushed.col(0) = Vec3(1, 2, 3);
    for (const Mat3& f : {turned_inside_out, Mat3(Mat3::Identity()), Mat3(-turned_inside_out),
                          crushed, Mat3(Mat3::Zero())}) {
        const detail::PrincipalStretches s = detail::principal_stretches(f);
        EXPECT_LT((s.u * s.sigma.asDiagonal() * s.v.transpose() - f).norm(), 1e-14);
        EXPECT_NEAR(s.u.determinant(), 1, 1e-14);
        EXPECT_NEAR(s.v.determinant(), 1, 1e-14);
        EXPECT_LT((s.u.transpose() * s.u - Mat3::Identity()).norm(), 1e-14);
        EXPECT_NEAR(s.sigma.prod(), f.determinant(), 1e-14);
    }
}

TEST(PrincipalStretches, OfFourAtOnceHaveTheBitsOfEachAlone) {
    std::array<Mat3, 4> four;
    for (int k = 0; k < 4; ++k)
        for (int i = 0; i < 9; ++i)
            four[static_cast<std::size_t>(k)].data()[i] = std::sin(1.0 + 5 * k + i * (k + 1));
    four[2] = Mat3::Identity();
    const std::array<detail::PrincipalStretches, 4> found = detail::principal_stretches(four);
    for (std::size_t k = 0; k < 4; ++k) {
        const detail::PrincipalStretches alone = detail::principal_stretches(four[k]);
        EXPECT_EQ(found[k].u, alone.u) << k;
        EXPECT_EQ(found[k].v, alone.v) << k;
        EXPECT_EQ(found[k].sigma, alone.sigma) << k;
    }
}

TEST(SecondDerivatives, OfTetsAreTheSlopeOfTheirForcesAlsoInsideOut) {
    const int count = static_cast<int>(kSmall.tets.rows());
    const TetSolid solid(kSmall.tets, kSmall.rest, Eigen::VectorXd::LinSpaced(count, 1e3, 3e3),
                         Eigen::VectorXd::LinSpaced(count, 3e4, 2e4));
    const Points wild = shaken(kSmall.rest, 5e-3, 21);
    EXPECT_GT(solid.inverted_count(wild), 0);
    for (const Points& x : {kSmall.rest, shaken(kSmall.rest, 8e-4, 20), wild}) {
        const Eigen::MatrixXd exact = dense_second(x.rows(), [&](solve::HessianBuilder& builder) {
            solid.add_hessian(x, Curvature::kExact, builder);
        });
        expect_slope_of_gradient(
            exact, x, [&](const Points& y, Points& g) { return solid.add_energy(y, g); }, kStep_m,
            kTolerance);
    }
    const auto second = [&](Curvature curvature) {
        return dense_second(wild.rows(), [&](solve::HessianBuilder& builder) {
            solid.add_hessian(wild, curvature, builder);
        });
    };
    expect_positive_part(second(Curvature::kPositive), second(Curvature::kExact));
}

TEST(SecondDerivatives, OfSkinAreTheSlopeOfItsForces) {
    const int count = static_cast<int>(kSmall.top.rows());
    const SkinSheet skin(kSmall.top, kSmall.rest, Eigen::VectorXd::LinSpaced(count, 10, 30),
                         Eigen::VectorXd::LinSpaced(count, 2e-5, 1e-5));
    const Points x = shaken(kSmall.rest, 1.2e-3, 22);
    const auto second = [&](Curvature curvature) {
        return dense_second(x.rows(), [&](solve::HessianBuilder& builder) {
            skin.add_hessian(x, curvature, builder);
        });
    };
    const Eigen::MatrixXd exact = second(Curvature::kExact);
    expect_slope_of_gradient(
        exact, x, [&](const Points& y, Points& g) { return skin.add_energy(y, g); }, kStep_m,
        kTolerance);
    expect_positive_part(second(Curvature::kPositive), exact);
}

TEST(SecondDerivatives, OfZeroLengthSpringsAndContactsAreTheSlopeOfTheirForces) {
    const Points x = shaken(kSmall.rest, 1e-3, 23);
    const Vec3 slanted = Vec3(1, 2, -1).normalized();
    const ZeroLengthSprings springs(
        {{2, Vec3(1e-3, 0, 0), slanted, 30, 5}, {2, Vec3::Zero(), slanted, 1, 0}});
    const Eigen::MatrixXd held = dense_second(
        x.rows(), [&](solve::HessianBuilder& builder) { springs.add_hessian(builder); });
    expect_slope_of_gradient(
        held, x, [&](const Points& y, Points& g) { return springs.add_energy(y, g); }, 1e-5, 1e-9);

    Contacts contacts;
    Contacts::Contact touching{.node = 0,
                               .others = {3, 4, 5, 0},
                               .weights = {0.5, 0.3, 0.2, 0},
                               .count = 3,
                               .normal = slanted,
                               .stiffness_n_per_m = 40};
    touching.point = slanted * (Contacts::gap(touching, x) + 2e-4);
    Contacts::Contact apart = touching;
    apart.node = 1;
    apart.point = slanted * -1.0;
    contacts.set({touching, apart});
    ASSERT_NEAR(contacts.max_penetration(x), 2e-4, 1e-12);
    const Eigen::MatrixXd pushed = dense_second(
        x.rows(), [&](solve::HessianBuilder& builder) { contacts.add_hessian(x, builder); });
    expect_slope_of_gradient(
        pushed, x, [&](const Points& y, Points& g) { return contacts.add_energy(y, g); }, 1e-5,
        1e-9);
}

TEST(SecondDerivatives, OfContactsThatHardenAreTheSlopeOfTheirForces) {
    const Points x = shaken(kSmall.rest, 1e-3, 24);
    constexpr double kDepth_m = 2e-4, kHardens_m = 5e-5;
    Contacts::Contact touching{.node = 0,
                               .others = {3, 4, 5, 0},
                               .weights = {0.5, 0.3, 0.2, 0},
                               .count = 3,
                               .normal = Vec3(1, 2, -1).normalized(),
                               .stiffness_n_per_m = 40};
    touching.point = touching.normal * (Contacts::gap(touching, x) + kDepth_m);
    Contacts::Contact apart = touching;
    apart.node = 1;
    apart.point = apart.normal * -1.0;
    Contacts contacts;
    contacts.set_firm({touching, apart}, kHardens_m);
    const Eigen::MatrixXd pushed = dense_second(
        x.rows(), [&](solve::HessianBuilder& builder) { contacts.add_hessian(x, builder); });
    expect_slope_of_gradient(
        pushed, x, [&](const Points& y, Points& g) { return contacts.add_energy(y, g); }, kStep_m,
        kTolerance);
    // E = kc/(3 h) d^3: 2 kc d / h along the normal at the node that touches, and zero at the one that does not.
    EXPECT_NEAR(pushed.topLeftCorner(3, 3).trace(), 2 * 40 * kDepth_m / kHardens_m, 1e-6);
    EXPECT_EQ(pushed.block(3, 3, 3, 3).norm(), 0);
}

}  // namespace
}  // namespace risorius::tissue
