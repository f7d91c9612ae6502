#include "muscle/hill_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace risorius::muscle {
namespace {

const HillShape kShape;

using Curve = std::function<double(double, const HillShape&)>;

/// Central differences: error about 1e-9 at this step.
void expect_slope(const Curve& f, const Curve& slope, double from, double to) {
    const double h = 1e-6;
    for (double x = from; x <= to; x += 0.0137)
        EXPECT_NEAR(slope(x, kShape), (f(x + h, kShape) - f(x - h, kShape)) / (2 * h), 2e-8)
            << "at " << x;
}

/// Simpson from `zero`, 400 panels.
void expect_integral(const Curve& f, const Curve& integral, double zero, double x) {
    const int panels = 400;
    const double h = (x - zero) / panels;
    double sum = 0;
    for (int i = 0; i < panels; ++i) {
        const double a = zero + i * h;
        sum += h / 6 * (f(a, kShape) + 4 * f(a + h / 2, kShape) + f(a + h, kShape));
    }
    EXPECT_NEAR(integral(x, kShape), sum, 1e-7) << "to " << x;
}

TEST(HillShape, ActiveForceIsTheBellOfItsWidth) {
    EXPECT_EQ(active_force(1.0, kShape), 1.0);
    EXPECT_NEAR(active_force(0.55, kShape), std::exp(-1.0), 1e-15);
    EXPECT_NEAR(active_force(1.45, kShape), std::exp(-1.0), 1e-15);
    EXPECT_NEAR(active_force_integral(1.45, kShape), 0.45 * 0.746824132812427, 1e-14);
    EXPECT_EQ(active_force_integral(1.0, kShape), 0.0);
}

TEST(HillShape, ActiveSlopeAndIntegralAgreeWithTheCurve) {
    expect_slope(active_force, active_force_slope, 0.2, 2.2);
    for (const double l : {0.3, 0.7, 0.99, 1.2, 1.9})
        expect_integral(active_force, active_force_integral, 1.0, l);
}

TEST(HillShape, PassiveForceIsOneAtItsStrainAndSlackBelowRest) {
    EXPECT_EQ(passive_force(0.8, kShape), 0.0);
    EXPECT_EQ(passive_force(1.0, kShape), 0.0);
    EXPECT_NEAR(passive_force(1.7, kShape), 1.0, 1e-14);
    EXPECT_NEAR(passive_force(1.35, kShape), (std::exp(2.0) - 1) / (std::exp(4.0) - 1), 1e-14);
}

TEST(HillShape, PassiveForceIsLinearBeyondItsKnee) {
    const double knee = 1 + 1.5 * 0.7;
    const double slope = 4 * std::exp(6.0) / ((std::exp(4.0) - 1) * 0.7);
    EXPECT_NEAR(passive_force_slope(knee - 1e-9, kShape), slope, 1e-6);
    EXPECT_NEAR(passive_force_slope(knee + 1.0, kShape), slope, 1e-12);
    EXPECT_NEAR(passive_force(knee + 1.0, kShape) - passive_force(knee + 0.5, kShape), 0.5 * slope,
                1e-12);
}

TEST(HillShape, PassiveSlopeAndIntegralAgreeWithTheCurve) {
    expect_slope(passive_force, passive_force_slope, 0.5, 0.98);
    expect_slope(passive_force, passive_force_slope, 1.01, 2.03);
    expect_slope(passive_force, passive_force_slope, 2.06, 3.0);
    for (const double l : {0.7, 1.1, 1.7, 2.05})
        expect_integral(passive_force, passive_force_integral, 1.0, l);
    EXPECT_NEAR(passive_force_integral(2.6, kShape) - passive_force_integral(2.2, kShape),
                0.4 * passive_force(2.4, kShape), 1e-12);  // linear: the midpoint rule is exact
}

TEST(HillShape, VelocityForceHasThePublishedValues) {
    // Hill's hyperbola with a/F0 = 0.25, and the lengthening branch that meets it with the same slope
    const double table[][2] = {{-1.0, 0.00496}, {-0.75, 0.06250}, {-0.5, 0.16667}, {-0.25, 0.37500},
                               {-0.1, 0.64286}, {0.0, 1.0},       {0.1, 1.22222},  {0.25, 1.30303},
                               {0.5, 1.34483},  {1.0, 1.37037}};
    for (const auto& [v, f] : table) EXPECT_NEAR(velocity_force(v, kShape), f, 5.1e-6) << v;
    EXPECT_EQ(velocity_force(-1.1, kShape), 0.0);
    EXPECT_EQ(velocity_force(-3.0, kShape), 0.0);
}

TEST(HillShape, VelocityForceHasNoKinks) {
    for (const double v : {-1.1, -0.9, 0.0}) {
        EXPECT_NEAR(velocity_force(v - 1e-9, kShape), velocity_force(v + 1e-9, kShape), 1e-7);
        EXPECT_NEAR(velocity_force_slope(v - 1e-9, kShape), velocity_force_slope(v + 1e-9, kShape),
                    1e-6)
            << "at " << v;
    }
}

TEST(HillShape, VelocitySlopeAndIntegralAgreeWithTheCurve) {
    expect_slope(velocity_force, velocity_force_slope, -1.5, 1.5);
    for (const double v : {-0.3, -0.9, -1.0, -1.1, 0.2, 1.5})
        expect_integral(velocity_force, velocity_force_integral, 0.0, v);
    // Beyond the fade nothing is added
    EXPECT_EQ(velocity_force_integral(-2.0, kShape), velocity_force_integral(-1.1, kShape));
}

TEST(HillShape, TheCurvesOfTheInnerLoopAreTheSameCurves) {
    HillShape shape;
    shape.active_width = 0.5;
    shape.passive_exponent = 3;
    for (const HillShape& s : {kShape, shape}) {
        const LengthCurves curves(s);
        for (double l = 0.1; l < 3.5; l += 0.037) {
            // Both are right to rounding; the passive curve grows to some 100
            EXPECT_NEAR(curves.active(l).force, active_force(l, s), 1e-15);
            EXPECT_NEAR(curves.active(l).integral, active_force_integral(l, s), 1e-15);
            EXPECT_NEAR(curves.passive(l).force, passive_force(l, s), 1e-12);
            EXPECT_NEAR(curves.passive(l).integral, passive_force_integral(l, s), 1e-12);
        }
    }
}

TEST(HillShape, OtherConstantsKeepTheLaws) {
    HillShape shape;
    shape.velocity_curvature = 0.4;
    shape.lengthening_force = 1.8;
    shape.passive_exponent = 3;
    EXPECT_NEAR(velocity_force_slope(-1e-9, shape), velocity_force_slope(1e-9, shape), 1e-6);
    EXPECT_NEAR(passive_force(1.7, shape), 1.0, 1e-14);
    EXPECT_NEAR(velocity_force(1e6, shape), 1.8, 1e-5);
}

}  // namespace
}  // namespace risorius::muscle
