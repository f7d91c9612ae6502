// SPDX-License-Identifier: MIT
// Values as parts of the names of clips.
#include <gtest/gtest.h>

#include "risorius/design/conditions.h"

namespace risorius::design {
namespace {

TEST(ClipWord, HasLettersAndDigitsOnly) {
    EXPECT_EQ(clip_word("zygomaticus_major.l"), "zygomaticusMajorL");
    EXPECT_EQ(clip_word("0.25"), "0p25");
    EXPECT_EQ(clip_word("-3.5"), "m3p5");
    EXPECT_EQ(clip_word("../etc/passwd"), "etcPasswd");
    EXPECT_EQ(clip_word("happy face 2"), "happyFace2");
    EXPECT_EQ(clip_word("über"), "uber");
    EXPECT_EQ(clip_word("x_顔"), "xu9854");
}

}  // namespace
}  // namespace risorius::design
