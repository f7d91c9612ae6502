// SPDX-License-Identifier: MIT
#include "risorius/track/detail/curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace risorius::track {
namespace {

const std::vector<Key> kRamp{{0.2, 0.0}, {0.6, 0.8}, {1.0, 0.8}, {1.1, 0.1}, {2.0, 0.0}};

TEST(Curve, PassesThroughItsKeysAndIsHeldOutside) {
    for (Interpolation way :
         {Interpolation::kStep, Interpolation::kLinear, Interpolation::kSmooth}) {
        const Curve curve(kRamp, way);
        for (const Key& key : kRamp) EXPECT_EQ(curve.at(key.time_s), key.value);
        EXPECT_EQ(curve.at(-5), 0.0);
        EXPECT_EQ(curve.at(0.1999), 0.0);
        EXPECT_EQ(curve.at(99), 0.0);
    }
}

TEST(Curve, OfOneKeyIsConstant) {
    const Curve curve({{0.5, 0.3}}, Interpolation::kSmooth);
    for (double t : {0.0, 0.5, 3.0}) EXPECT_EQ(curve.at(t), 0.3);
}

TEST(Curve, StepKeepsTheLastKeyAndLinearIsStraight) {
    const Curve step({{0, 0}, {1, 1}}, Interpolation::kStep);
    EXPECT_EQ(step.at(0.999), 0.0);
    EXPECT_EQ(step.at(1.0), 1.0);
    const Curve linear({{0, 0}, {1, 1}}, Interpolation::kLinear);
    EXPECT_DOUBLE_EQ(linear.at(0.25), 0.25);
}

TEST(Curve, SmoothIsC1EverywhereAlsoAtItsEnds) {
    const Curve curve(kRamp, Interpolation::kSmooth);
    const double h = 1e-6;
    for (const Key& key : kRamp) {
        const double left = (curve.at(key.time_s) - curve.at(key.time_s - h)) / h;
        const double right = (curve.at(key.time_s + h) - curve.at(key.time_s)) / h;
        // The maximum curvature of these pieces is about 6 * 0.7 / 0.1^2 = 420 /s^2, times h.
        EXPECT_NEAR(left, right, 1e-3) << "at " << key.time_s;
    }
}

TEST(Curve, SmoothNeverOvershootsAndIsMonotoneBetweenKeys) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int round = 0; round < 200; ++round) {
        std::vector<Key> keys;
        double t = 0;
        for (int i = 0; i < 6; ++i) keys.push_back({t += 0.01 + unit(random), unit(random)});
        const Curve curve(keys, Interpolation::kSmooth);
        for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
            const double sign = keys[i + 1].value >= keys[i].value ? 1 : -1;
            double previous = keys[i].value;
            for (int k = 1; k <= 50; ++k) {
                const double now =
                    curve.at(keys[i].time_s + k / 50.0 * (keys[i + 1].time_s - keys[i].time_s));
                ASSERT_GE(sign * (now - previous), -1e-12) << "round " << round << " piece " << i;
                previous = now;
            }
        }
    }
}

TEST(Curve, SmoothSlopeOnEvenlyRisingKeysIsTheirSlope) {
    const Curve curve({{0, 0}, {1, 1}, {2, 2}, {3, 3}}, Interpolation::kSmooth);
    EXPECT_NEAR(curve.at(1.5), 1.5, 1e-15);
    EXPECT_NEAR((curve.at(1.5 + 1e-6) - curve.at(1.5 - 1e-6)) / 2e-6, 1.0, 1e-8);
}

TEST(MinimumJerk, StartsAndEndsAtRestWithPeakSpeedInTheMiddle) {
    EXPECT_EQ(minimum_jerk(-1), 0.0);
    EXPECT_EQ(minimum_jerk(0), 0.0);
    EXPECT_EQ(minimum_jerk(0.5), 0.5);
    EXPECT_EQ(minimum_jerk(1), 1.0);
    EXPECT_EQ(minimum_jerk(2), 1.0);
    // The peak speed is 1.875 times the mean (Flash & Hogan 1985).
    EXPECT_NEAR((minimum_jerk(0.5 + 1e-5) - minimum_jerk(0.5 - 1e-5)) / 2e-5, 1.875, 1e-6);
    EXPECT_NEAR(minimum_jerk(1e-3), 1e-8, 2e-11);  // 10 s^3
}

}  // namespace
}  // namespace risorius::track
