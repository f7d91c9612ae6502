// SPDX-License-Identifier: MIT
#include "risorius/geom/fitted_sphere.h"

#include <gtest/gtest.h>

#include <cmath>

namespace risorius::geom {
namespace {

TEST(FittedSphere, FindsTheSphereOfACapOfIt) {
    // As much of an eye as a scan shows, far from the origin.
    const Vec3 centre(0.031, 1.62, 0.074);
    constexpr double kRadius = 0.012;
    std::vector<Vec3> cap;
    for (int i = 1; i <= 5; ++i)
        for (int j = 0; j < 8; ++j) {
            const double polar = 0.15 * i, azimuth = 0.785 * j;
            cap.push_back(centre + kRadius * Vec3(std::sin(polar) * std::cos(azimuth),
                                                  std::sin(polar) * std::sin(azimuth),
                                                  std::cos(polar)));
        }
    const Sphere sphere = fitted_sphere(cap);
    EXPECT_NEAR(sphere.radius, kRadius, 1e-11);
    EXPECT_LT((sphere.centre - centre).norm(), 1e-11);
}

TEST(FittedSphere, LiesBetweenPointsThatAreOnNone) {
    const Sphere sphere =
        fitted_sphere({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 2}, {0, 0, -2}});
    EXPECT_LT(sphere.centre.norm(), 1e-15);
    EXPECT_NEAR(sphere.radius, std::sqrt(2.0), 1e-15);  // r^2 is the mean of 1, 1, 1, 1, 4 and 4
}

}  // namespace
}  // namespace risorius::geom
