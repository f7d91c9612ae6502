// SPDX-License-Identifier: MIT
// Passive fibres resist stretch along themselves, by the law of their source, and nothing else.
#include "risorius/tissue/collagen_tets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tissue/term_checks.h"

namespace risorius::tissue {
namespace {

constexpr double kK1_pa = 700, kK2 = 3;
const Vec3 kAlong = Vec3(1, 2, -0.5).normalized();

Points two_tets() {
    Points rest(5, 3);
    rest << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1;
    return rest;
}

CollagenTets fibres(double k2 = kK2, const Vec3& along = kAlong) {
    return CollagenTets(
        {{.nodes = {0, 1, 2, 3}, .tet = 0, .along = along, .k1_pa = kK1_pa, .k2 = k2},
         {.nodes = {1, 4, 2, 3}, .tet = 1, .along = along, .k1_pa = kK1_pa, .k2 = k2}},
        two_tets());
}

Points deformed(const Mat3& f) { return two_tets() * f.transpose(); }

// Stretches by l along the fibres and by any ratio across them.
Mat3 stretched(double l, double across) {
    const Mat3 along = kAlong * kAlong.transpose();
    return l * along + across * (Mat3::Identity() - along);
}

TEST(CollagenTets, ForceAndSecondDerivativeAreThoseOfTheEnergy) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal(0, 0.15);
    for (const double k2 : {0.0, kK2, 40.0}) {
        Points x = deformed(stretched(1.3, 0.8));
        for (double& v : x.reshaped()) v += normal(random);
        laws::expect_force_is_exact(fibres(k2), x, 1e-6);
        laws::expect_potential_is_exact(fibres(k2), two_tets(), x, 0.01);
    }
}

TEST(CollagenTets, StressOfAStretchIsThatOfHolzapfelGasserAndOgden) {
    const CollagenTets term = fibres();
    for (const double l : {1.05, 1.2, 1.5})
        for (const double across : {0.7, 1.0}) {
            const double u = l * l - 1, slope = kK1_pa * u * std::exp(kK2 * u * u);
            const Mat3 expected =
                2 * slope * l * l / (l * across * across) * kAlong * kAlong.transpose();
            const Points x = deformed(stretched(l, across));
            EXPECT_LT((term.cauchy_stress_pa(x, 1) - expected).norm(), 1e-9 * expected.norm());
            EXPECT_NEAR(term.stretch(x, 0), l, 1e-12);
            const double energy =
                0.5 * kK1_pa / kK2 * (std::exp(kK2 * u * u) - 1) * (1.0 / 6 + 2.0 / 6);
            EXPECT_NEAR(term.energy(0, x), energy, 1e-9 * energy);
        }
    // The modulus at rest is 4 k1
    const double strain = 1e-6;
    EXPECT_NEAR(term.cauchy_stress_pa(deformed(stretched(1 + strain, 1)), 0).trace() / strain,
                4 * kK1_pa, 0.1);
}

TEST(CollagenTets, SlackFibresPushNothing) {
    const CollagenTets term = fibres();
    const Points x = deformed(stretched(0.9, 1.4));
    EXPECT_EQ(term.energy(0, x), 0);
    EXPECT_EQ(laws::force_of(term, x).norm(), 0);
    // And at rest nothing pulls
    EXPECT_LT(laws::force_of(term, two_tets()).norm(), 1e-9);
}

TEST(CollagenTets, TheLawGoesOnWithoutAJumpAndWithoutOverflow) {
    const CollagenTets term = fibres(40);
    const double end = std::sqrt(1 + std::sqrt(6.0 / 40));  // l where k2 u^2 is 6
    const auto pull = [&](double l) {
        return term.cauchy_stress_pa(deformed(stretched(l, 1)), 0).trace();
    };
    EXPECT_NEAR(pull(end - 1e-7) / pull(end + 1e-7), 1, 1e-4);
    EXPECT_GT(pull(3), pull(2));
    EXPECT_TRUE(std::isfinite(term.energy(0, deformed(stretched(50, 1)))));
    EXPECT_TRUE(std::isfinite(term.energy(0, deformed(stretched(-2, 1))))) << "inverted";
}

TEST(CollagenTets, ATurnedBodyHasTheSameEnergyAndTurnedForces) {
    const CollagenTets term = fibres();
    const Points x = deformed(stretched(1.2, 0.9));
    const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, -1, 2).normalized()).toRotationMatrix();
    const Points turned = x * turn.transpose();
    EXPECT_NEAR(term.energy(0, turned), term.energy(0, x), 1e-9 * term.energy(0, x));
    EXPECT_LT((laws::force_of(term, turned) - laws::force_of(term, x) * turn.transpose()).norm(),
              1e-9 * laws::force_of(term, x).norm());
}

TEST(CollagenTets, FlatTetrahedraAreRefused) {
    Points flat = two_tets();
    flat.row(3) << 0.5, 0.5, 0;
    EXPECT_THROW(CollagenTets({{.k1_pa = 1}}, flat), std::invalid_argument);
    EXPECT_THROW(CollagenTets({{.nodes = {0, 1, 2, 3}, .k1_pa = 1}}, flat), std::invalid_argument);
}

}  // namespace
}  // namespace risorius::tissue
