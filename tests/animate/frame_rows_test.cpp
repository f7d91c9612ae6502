// SPDX-License-Identifier: MIT
// A table of frames taken apart again, and the moments of a motion found in it.
#include "risorius/animate/frame_rows.h"

#include <gtest/gtest.h>

namespace risorius::animate {
namespace {

TEST(Moments, AreOfTheLandmarkThatGoesFarthest) {
    const FrameRows rows = frame_rows(
        "frame\ttime_s\tpg.x_mm\tpg.y_mm\tpg.z_mm\tpg.u_px\n0\t0\t1\t2\t3\t9\n1\t0.1\t1\t2."
        "1\t3\t8\n"
        "2\t0.2\t1\t5\t7\t7\n3\t0.3\t1\t2\t4\t6\n");
    const std::vector<double> displacements = max_landmark_displacements(rows);
    ASSERT_EQ(displacements.size(), 4u);
    EXPECT_NEAR(displacements[2], 5e-3, 1e-12);
    const Moments moments = moments_of(displacements);
    EXPECT_EQ(moments.onset, 2);
    EXPECT_EQ(moments.apex, 2);
    EXPECT_EQ(moments_of({0, 0}).onset, 0);
    EXPECT_EQ(moments_of({0, 0}).apex, 0);
    // Of a face that is held, not the frame in which it happens to have crept farthest
    EXPECT_EQ(moments_of({0, 4e-3, 12.84e-3, 12.85e-3, 12.851e-3, 12e-3}).apex, 2);
}

}  // namespace
}  // namespace risorius::animate
