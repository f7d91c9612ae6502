// SPDX-License-Identifier: MIT
// Strain as it is shown.
#include "risorius/scene/visualization.h"

#include <gtest/gtest.h>

#include <cmath>

namespace risorius::scene {
namespace {

TEST(PrincipalStrain, IsThatOfAHomogeneousStretchInAnyDirection) {
    Points rest(5, 3);
    rest << 0, 0, 0, 0.01, 0, 0, 0.013, 0.009, 0, -0.002, 0.011, 0, 1, 1, 1;
    Triangles skin(2, 3);
    skin << 0, 1, 2, 0, 2, 3;
    for (const auto& [along, across, expected] :
         {std::tuple{1.2, 1.0, 0.2}, {1.1, 0.7, -0.3}, {1.0, 1.0, 0.0}}) {
        const Mat3 turn(Eigen::AngleAxisd(0.6, Vec3::UnitZ()));
        const Mat3 tilt(Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized()));
        const Mat3 stretch = tilt * turn * Vec3(along, across, 1).asDiagonal() * turn.transpose();
        const Points moved = rest * stretch.transpose();
        const std::vector<double> strain = principal_strain(skin, rest, moved);
        for (std::size_t v = 0; v < 4; ++v) EXPECT_NEAR(strain[v], expected, 1e-9);
        EXPECT_TRUE(std::isnan(strain[4])) << "not on the skin";
    }
}

}  // namespace
}  // namespace risorius::scene
