// SPDX-License-Identifier: MIT
#include "risorius/speech/gaze.h"

#include <gtest/gtest.h>

#include <cmath>

#include "speech/curve_helpers.h"

namespace risorius::speech {
namespace {

Utterance long_sentence() {
    Utterance u = utterance_of({{"m", .5}, {"ɑ", 2.5}, {"t", .5}, {"o", 2.5}});
    u.sentences = {{"mato", 0, u.samples}};
    return u;
}

TEST(Gaze, LooksAwayWhileASentenceBeginsAndAtTheListenerAfterwards) {
    const std::vector<GazeShift> shifts = gaze_of(long_sentence(), 1, 3);
    ASSERT_GT(shifts.size(), 3u);
    EXPECT_GT(std::abs(gaze_at(shifts, 0.1).x()), 5.9);
    double farthest = 0, moved = 0;
    for (double t_s = 0.4; t_s < 6; t_s += 0.05) {
        farthest = std::max(farthest, gaze_at(shifts, t_s).norm());
        moved = std::max(moved, (gaze_at(shifts, t_s) - gaze_at(shifts, 0.4)).norm());
    }
    EXPECT_LT(farthest, 2.1);
    EXPECT_GT(moved, 0.2);
    EXPECT_EQ(gaze_at(shifts, -1), Vec2::Zero());
    EXPECT_EQ(gaze_at(shifts, 10), Vec2::Zero());
}

TEST(Gaze, ShiftsFollowEachOtherAndDependOnTheSeedAlone) {
    const auto one = gaze_of(long_sentence(), 1, 3), same = gaze_of(long_sentence(), 1, 3),
               other = gaze_of(long_sentence(), 1, 4);
    ASSERT_EQ(one.size(), same.size());
    bool differs = one.size() != other.size();
    for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_EQ(one[i].yaw_deg, same[i].yaw_deg);
        EXPECT_EQ(one[i].start_s, same[i].start_s);
        if (!differs) differs = one[i].yaw_deg != other[i].yaw_deg;
        if (i > 0) {
            EXPECT_GE(one[i].start_s, one[i - 1].start_s + one[i - 1].duration_s);
        }
    }
    EXPECT_TRUE(differs);
    EXPECT_TRUE(gaze_of(long_sentence(), 0, 3).empty());
    EXPECT_NEAR(gaze_at(gaze_of(long_sentence(), 0.5, 3), 0.1).x(), gaze_at(one, 0.1).x() / 2,
                1e-9);
}

}  // namespace
}  // namespace risorius::speech
