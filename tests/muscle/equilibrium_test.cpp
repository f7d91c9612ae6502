// SPDX-License-Identifier: MIT
// A musculotendon in equilibrium in one dimension, and how its five parameters scale it.

#include "risorius/muscle/equilibrium.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace risorius::muscle {
namespace {

const MuscleParameters kMuscle{.f0_n = 94.2, .optimal_length_m = 0.04, .tendon_slack_m = 0.02};

MuscleParameters pennated(double deg) {
    MuscleParameters p = kMuscle;
    p.pennation_deg = deg;
    return p;
}

MuscleParameters rigidly(MuscleParameters parameters) {
    parameters.tendon = TendonModel::kRigid;
    return parameters;
}

TEST(Equilibrium, FibreAndTendonPullAlike) {
    for (const std::string_view set : curve_set_names()) {
        const MuscleCurves curves = make_curves(curve_set_named(std::string(set)));
        for (const double deg : {0.0, 30.0})
            for (double length = 0.045; length < 0.08; length += 0.005)
                for (const double a : {0.1, 1.0}) {
                    const MuscleParameters p = pennated(deg);
                    const Equilibrium at = equilibrium(p, curves, a, length);
                    const double span = at.fibre_m * std::cos(at.pennation_rad);
                    EXPECT_NEAR(span + at.tendon_m, length, 1e-15);
                    const double along = fibre_force(p, curves, a, at.fibre_m, 0);
                    EXPECT_NEAR(along * std::cos(at.pennation_rad), at.force_n, 1e-10);
                    EXPECT_NEAR(p.f0_n * curves.tendon.value(at.tendon_m / 0.02 - 1), at.force_n,
                                1e-9 * p.f0_n)
                        << set << ", " << deg << " deg, " << length << " m, a = " << a;
                }
    }
}

TEST(Equilibrium, OfAStiffTendonIsThatOfARigidOne) {
    const MuscleCurves stiff = zajac_curves({.tendon_strain = 1e-6});
    for (double length = 0.05; length < 0.08; length += 0.005) {
        const Equilibrium elastic = equilibrium(kMuscle, stiff, 0.7, length);
        const Equilibrium rigid = equilibrium(rigidly(kMuscle), zajac_curves(), 0.7, length);
        EXPECT_NEAR(elastic.force_n, rigid.force_n, 1e-3);
        EXPECT_DOUBLE_EQ(rigid.tendon_m, 0.02);
        EXPECT_DOUBLE_EQ(rigid.fibre_m, length - 0.02);
    }
}

TEST(Equilibrium, ASlackMuscleHasNoForce) {
    const MuscleCurves curves = zajac_curves();
    EXPECT_EQ(equilibrium(kMuscle, curves, 0, 0.055).force_n, 0);
    EXPECT_EQ(equilibrium(kMuscle, curves, 1, 0.015).force_n, 0);
}

TEST(Scaling, ForceGrowsWithF0AndLengthsStay) {
    const MuscleCurves curves = zajac_curves();
    MuscleParameters strong = kMuscle;
    strong.f0_n *= 3;
    const Equilibrium one = equilibrium(kMuscle, curves, 0.6, 0.065);
    const Equilibrium three = equilibrium(strong, curves, 0.6, 0.065);
    EXPECT_DOUBLE_EQ(three.force_n, 3 * one.force_n);
    EXPECT_EQ(three.fibre_m, one.fibre_m);
}

TEST(Scaling, AMuscleOfTwiceTheLengthsHasTheSameForceAtTwiceTheLength) {
    const MuscleCurves curves = zajac_curves();
    MuscleParameters large = pennated(20), small = large;
    large.optimal_length_m *= 2;
    large.tendon_slack_m *= 2;
    for (const double length : {0.05, 0.06, 0.07})
        EXPECT_NEAR(equilibrium(large, curves, 1, 2 * length).force_n,
                    equilibrium(small, curves, 1, length).force_n, 1e-9);
}

TEST(Scaling, ALongerTendonGivesMoreAtTheSameForce) {
    const MuscleCurves curves = zajac_curves();
    MuscleParameters compliant = kMuscle;
    compliant.tendon_slack_m = 0.2;
    const Equilibrium near = equilibrium(kMuscle, curves, 1, 0.06);
    const Equilibrium far = equilibrium(compliant, curves, 1, 0.24);
    EXPECT_LT(far.fibre_m, near.fibre_m - 0.004);  // ten times the stretch of about 0.6 mm
}

TEST(Scaling, SpeedScalesWithGreatestSpeedAndOptimalLength) {
    const MuscleCurves curves = zajac_curves();
    MuscleParameters fast = kMuscle;
    fast.max_speed_hz *= 2;
    MuscleParameters longer = kMuscle;
    longer.optimal_length_m *= 2;
    for (const double speed : {-0.3, -0.1, 0.05}) {
        const double force = fibre_force(kMuscle, curves, 1, 0.04, speed);
        EXPECT_DOUBLE_EQ(fibre_force(fast, curves, 1, 0.04, 2 * speed), force);
        EXPECT_DOUBLE_EQ(fibre_force(longer, curves, 1, 0.08, 2 * speed), force);
    }
    // At vmax only damping and the rounded end of Hill's curve are left.
    EXPECT_NEAR(fibre_force(kMuscle, curves, 1, 0.04, -0.4), 94.2 * (0.00496 - 0.05), 1e-3);
}

TEST(Scaling, PennationGrowsAtConstantThickness) {
    const MuscleCurves curves = zajac_curves();
    const double thickness = 0.04 * std::sin(25 * std::numbers::pi / 180);
    for (double length = 0.045; length < 0.075; length += 0.005) {
        const Equilibrium at = equilibrium(rigidly(pennated(25)), curves, 1, length);
        EXPECT_NEAR(at.fibre_m * std::sin(at.pennation_rad), thickness, 1e-15);
    }
    // At the optimal length, the fraction cos(alpha) of F0 reaches the tendon.
    const double cosine = std::cos(25 * std::numbers::pi / 180);
    EXPECT_NEAR(equilibrium(rigidly(pennated(25)), curves, 1, 0.02 + 0.04 * cosine).force_n,
                94.2 * cosine, 1e-9);
}

}  // namespace
}  // namespace risorius::muscle
