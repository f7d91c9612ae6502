// SPDX-License-Identifier: MIT
// Tables of curves: where they agree with the curve, and that their force is the slope of their energy.
#include "risorius/muscle/detail/curve_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "risorius/muscle/detail/hill_shape.h"
#include "risorius/muscle/muscle_curves.h"

namespace risorius::muscle {
namespace {

const Curve kVelocity = zajac_curves().velocity;
const CurveTable kTable(kVelocity, -1.5, 1.5, 768);

TEST(CurveTable, AgreesWithTheCurveAtTheEndsOfItsCells) {
    for (int i = 0; i < 768; i += 7) {
        const double x = -1.5 + i * (3.0 / 768);
        EXPECT_NEAR(kTable.at(x).value, kVelocity.at(x).value, 1e-12);
        EXPECT_NEAR(kTable.at(x).integral, kVelocity.at(x).integral, 1e-12);
    }
    EXPECT_EQ(kTable.at(0).value, 1.0);  // a fibre that has stopped has its static force
}

TEST(CurveTable, IsWithinAHundredThousandthBetweenThem) {
    double worst = 0;
    for (int i = 0; i < 5000; ++i) {
        const double x = -1.499 + i * 2.998 / 5000;
        worst = std::max(worst, std::abs(kTable.at(x).value - kVelocity.at(x).value));
    }
    EXPECT_LT(worst, 1e-5);
    EXPECT_GT(worst, 0.0);
}

TEST(CurveTable, ValueIsTheSlopeOfTheIntegral) {
    for (double x = -1.4; x < 1.4; x += 0.0173) {
        constexpr double kStep = 1e-5;
        const double slope =
            (kTable.at(x + kStep).integral - kTable.at(x - kStep).integral) / (2 * kStep);
        EXPECT_NEAR(kTable.at(x).value, slope, 1e-6) << x;
    }
}

TEST(CurveTable, AsksTheCurveBeyondItsEnds) {
    const CurveTable passive(passive_curve({}), 1.0, 3.0, 64);
    const Curve curve = passive_curve({});
    for (const double x : {0.2, 0.999, 3.0, 7.5}) {
        EXPECT_EQ(passive.at(x).value, curve.at(x).value);
        EXPECT_EQ(passive.at(x).integral, curve.at(x).integral);
    }
    EXPECT_TRUE(std::isnan(passive.at(std::nan("")).value));
}

}  // namespace
}  // namespace risorius::muscle
