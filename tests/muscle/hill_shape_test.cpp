// SPDX-License-Identifier: MIT
#include "risorius/muscle/detail/hill_shape.h"

#include <gtest/gtest.h>

#include <cmath>

namespace risorius::muscle {
namespace {

const HillShape kShape;

TEST(HillShape, ActiveForceIsTheBellOfItsWidth) {
    const Curve active = active_curve(kShape);
    EXPECT_EQ(active.value(1.0), 1.0);
    EXPECT_NEAR(active.value(0.55), std::exp(-1.0), 1e-15);
    EXPECT_NEAR(active.value(1.45), std::exp(-1.0), 1e-15);
    EXPECT_NEAR(active.at(1.45).integral, 0.45 * 0.746824132812427, 1e-14);
    EXPECT_EQ(active.at(1.0).integral, 0.0);
}

TEST(HillShape, PassiveForceIsOneAtItsStrainAndSlackBelowRest) {
    const Curve passive = passive_curve(kShape);
    EXPECT_EQ(passive.value(0.8), 0.0);
    EXPECT_EQ(passive.value(1.0), 0.0);
    EXPECT_NEAR(passive.value(1.7), 1.0, 1e-14);
    EXPECT_NEAR(passive.value(1.35), (std::exp(2.0) - 1) / (std::exp(4.0) - 1), 1e-14);
    EXPECT_NEAR(passive.at(1.0).slope, 4 / (0.7 * (std::exp(4.0) - 1)), 1e-12);
}

TEST(HillShape, PassiveForceIsLinearBeyondItsKnee) {
    const Curve passive = passive_curve(kShape);
    const double knee = 1 + 1.5 * 0.7;
    const double slope = 4 * std::exp(6.0) / ((std::exp(4.0) - 1) * 0.7);
    EXPECT_NEAR(passive.at(knee - 1e-9).slope, slope, 1e-6);
    EXPECT_NEAR(passive.at(knee + 1.0).slope, slope, 1e-12);
    EXPECT_NEAR(passive.value(knee + 1.0) - passive.value(knee + 0.5), 0.5 * slope, 1e-12);
}

TEST(HillShape, SlopesAndIntegralsAgreeWithDifferences) {
    const double h = 1e-6;  // central difference: the error is about 1e-9
    for (const Curve& curve : {active_curve(kShape), passive_curve(kShape)})
        for (double l = 0.2037; l < 3; l += 0.0137) {
            const Curve::Value up = curve.at(l + h), down = curve.at(l - h);
            EXPECT_NEAR(curve.at(l).slope, (up.value - down.value) / (2 * h), 2e-7) << "at " << l;
            EXPECT_NEAR(curve.value(l), (up.integral - down.integral) / (2 * h),
                        1e-8 * (1 + up.value))
                << "at " << l;
        }
}

TEST(HillShape, TheCurvesOfTheInnerLoopAreTheSameCurves) {
    HillShape shape;
    shape.active_width = 0.5;
    shape.passive_exponent = 3;
    for (const HillShape& s : {kShape, shape}) {
        const LengthCurves curves(s);
        const Curve active = active_curve(s), passive = passive_curve(s);
        for (double l = 0.1; l < 3.5; l += 0.037) {
            // Both are right up to rounding; the passive curve grows to about 100.
            EXPECT_NEAR(curves.active(l).force, active.value(l), 1e-15);
            EXPECT_NEAR(curves.active(l).integral, active.at(l).integral, 1e-15);
            EXPECT_NEAR(curves.passive(l).force, passive.value(l), 1e-12);
            EXPECT_NEAR(curves.passive(l).integral, passive.at(l).integral, 1e-12);
        }
    }
}

}  // namespace
}  // namespace risorius::muscle
