// SPDX-License-Identifier: MIT
#include "risorius/tissue/detail/hinge_angle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace risorius::tissue {
namespace {

HingeCorners folded_corners(double angle) {
    return {Vec3(0, 0, 0), Vec3(0, 2, 0), Vec3(-1.5, 0.4, 0),
            Vec3(1.2 * std::cos(angle), 1.1, 1.2 * std::sin(angle))};
}

HingeCorners random_hinge(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-0.4, 0.4);
    HingeCorners x = folded_corners(0.8);
    for (Vec3& p : x)
        for (int k = 0; k < 3; ++k) p[k] += uniform(random);
    return x;
}

TEST(HingeAngle, IsTheTurnFromFlat) {
    // n1 = e x (xa - x0) points up here, and folding up is towards it.
    for (const double angle : {-2.5, -0.3, 0.0, 0.7, 3.0})
        EXPECT_NEAR(hinge_angle(folded_corners(angle)), -angle, 1e-14);
    const HingeCorners x = random_hinge(1);
    EXPECT_NEAR(hinge_angle({x[1], x[0], x[3], x[2]}), hinge_angle(x), 1e-14);
    EXPECT_NEAR(hinge_angle({x[0], x[1], x[3], x[2]}), -hinge_angle(x), 1e-14);
}

TEST(HingeAngle, DerivativesAgreeWithDifferences) {
    const double h = 1e-5;
    for (unsigned seed = 0; seed < 5; ++seed) {
        const HingeCorners x = random_hinge(seed);
        const auto gradient = hinge_angle_gradient(x);
        const auto hessian = hinge_angle_hessian(x);
        for (std::size_t i = 0; i < 4; ++i)
            for (int c = 0; c < 3; ++c) {
                HingeCorners above = x, below = x;
                above[i][c] += h;
                below[i][c] -= h;
                EXPECT_NEAR((hinge_angle(above) - hinge_angle(below)) / (2 * h), gradient[i][c],
                            1e-8);
                const auto slope_above = hinge_angle_gradient(above);
                const auto slope_below = hinge_angle_gradient(below);
                for (std::size_t j = 0; j < 4; ++j)
                    for (int d = 0; d < 3; ++d)
                        EXPECT_NEAR((slope_above[j][d] - slope_below[j][d]) / (2 * h),
                                    hessian[j][i](d, c), 1e-7)
                            << i << c << j << d;
            }
    }
}

}  // namespace
}  // namespace risorius::tissue
