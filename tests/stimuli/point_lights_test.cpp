// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/point_lights.h"

#include <gtest/gtest.h>

#include <cmath>

namespace risorius::stimuli {
namespace {

constexpr int kSide_px = 100;

/// Two frames with three landmarks, of which one moves 8 px to the right.
animate::FrameRows three_landmarks() {
    return {.names = {"ch_l.u_px", "ch_l.v_px", "prn.u_px", "prn.v_px", "n.u_px", "n.v_px"},
            .cells = {{"20.5", "30.5", "60.5", "50.5", "40.5", "80.5"},
                      {"28.5", "30.5", "60.5", "50.5", "40.5", "80.5"}}};
}

float at(const std::vector<float>& covered, int x, int y) {
    return covered[static_cast<std::size_t>(y * kSide_px + x)];
}

TEST(PointLights, LieOnTheLandmarksAndHaveTheAreaOfTheirRadius) {
    const animate::FrameRows rows = three_landmarks();
    const PointLights dots(rows, 3, 3, false, 1);
    ASSERT_EQ(dots.count(), 3);
    for (const int frame : {0, 1}) {
        const std::vector<float> covered = dots.covered(frame, kSide_px, kSide_px);
        EXPECT_EQ(at(covered, 60, 50), 1);
        EXPECT_EQ(at(covered, 40, 80), 1);
        EXPECT_EQ(at(covered, 20, 30), frame == 0 ? 1 : 0);
        EXPECT_EQ(at(covered, 28, 30), frame == 0 ? 0 : 1);
        double area = 0;
        for (const float share : covered) area += static_cast<double>(share);
        EXPECT_NEAR(area, 3 * 3.14159 * 9, 2);
    }
    EXPECT_EQ(PointLights(rows, 2, 3, false, 1).count(), 2) << "the first ones of the fixed order";
}

TEST(PointLights, ScatteredMoveAsBefore) {
    const animate::FrameRows rows = three_landmarks();
    const auto middle_of_change = [&](unsigned seed) {
        const PointLights dots(rows, 3, 1, true, seed);
        const std::vector<float> first = dots.covered(0, kSide_px, kSide_px),
                                 then = dots.covered(1, kSide_px, kSide_px);
        double x = 0, all = 0;
        for (int i = 0; i < kSide_px * kSide_px; ++i) {
            x += (static_cast<double>(then[static_cast<std::size_t>(i)]) -
                  static_cast<double>(first[static_cast<std::size_t>(i)])) *
                 (i % kSide_px);
            all += static_cast<double>(first[static_cast<std::size_t>(i)]);
        }
        return x / (all / 3);
    };
    EXPECT_NEAR(middle_of_change(2), 8, 0.8);
    EXPECT_NE(PointLights(rows, 3, 1, true, 2).covered(0, kSide_px, kSide_px),
              PointLights(rows, 3, 1, true, 3).covered(0, kSide_px, kSide_px));
}

}  // namespace
}  // namespace risorius::stimuli
