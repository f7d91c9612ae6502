// SPDX-License-Identifier: MIT
// What a seed draws beside the tones, and that nobody has it who does not ask for it.
#include "risorius/render/detail/complexion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "risorius/render/detail/skin_paint.h"
#include "risorius/render/detail/skin_plan.h"

namespace risorius::render {
namespace {

TEST(Complexion, IsUsualUnlessAskedFor) {
    Appearance appearance;
    for (const unsigned seed : {1U, 77U}) {
        appearance.seed = seed;
        const Complexion usual = complexion_of(appearance);
        EXPECT_EQ(usual.eyes, 1);
        EXPECT_EQ(usual.cheeks, 1);
        EXPECT_EQ(usual.nose, 1);
        EXPECT_EQ(usual.lashes, 1);
        EXPECT_EQ(usual.brows, 1);
        EXPECT_EQ(usual.moles, 0);
        EXPECT_EQ(lip_tone_at(appearance), linear_from_srgb(appearance.lip_tone));
    }
}

TEST(Complexion, DiffersBetweenSeedsAboutTheUsual) {
    Appearance appearance;
    appearance.complexion = 1;
    double lips = 0, cheeks = 0, reddest = 0, palest = 1e9, least = 1e9, most = 0;
    int moles = 0;
    constexpr int kPeople = 200;
    for (unsigned seed = 1; seed <= kPeople; ++seed) {
        appearance.seed = seed;
        const Complexion own = complexion_of(appearance);
        cheeks += std::log(own.cheeks) / kPeople;
        lips += std::log(own.lips.y()) / kPeople;
        least = std::min(least, own.cheeks);
        most = std::max(most, own.cheeks);
        moles += own.moles;
        EXPECT_EQ(complexion_of(appearance).lips, own.lips);
        reddest = std::max(reddest, own.nose);
        palest = std::min(palest, own.nose);
    }
    EXPECT_LE(reddest, 1.0) << "no red nose";
    EXPECT_LT(palest, 0.5);
    EXPECT_NEAR(cheeks, 0, 0.15);
    EXPECT_NEAR(lips, 0, 0.08);
    EXPECT_LT(least, 0.6);
    EXPECT_GT(most, 1.7);
    EXPECT_GT(moles, kPeople);  // of up to 6 each, most have few
    EXPECT_LT(moles, 3 * kPeople);
}

/// The skin around the eyes darkens with the years.
TEST(Complexion, ShadeAroundTheEyesGrowsWithAge) {
    Appearance appearance;
    appearance.complexion = 1;
    for (unsigned seed = 1; seed <= 20; ++seed) {
        appearance.seed = seed;
        appearance.age = 0;
        const double young = complexion_of(appearance).eyes;
        appearance.age = 1;
        const double old = complexion_of(appearance).eyes;
        EXPECT_GE(old, std::min(2.2, 1.6 * young)) << seed;
    }
}

/// Short hair is drawn hair by hair, so that grey is white beside dark, and a few white ones are hardly seen.
TEST(GreyBeard, HasFewWhiteHairsUntilMostAreWhite) {
    Appearance appearance;
    appearance.hair_tone = Vec3(0.10, 0.08, 0.07);
    appearance.grey_hair = 0;
    EXPECT_EQ(white_share_of_beard(appearance), 0);
    EXPECT_EQ(hair_tone_at(appearance), dark_hair_tone(appearance));
    appearance.grey_hair = 0.23;
    EXPECT_LT(white_share_of_beard(appearance), 0.12);
    EXPECT_LT(white_share_of_brows(appearance), white_share_of_beard(appearance));
    EXPECT_GT(hair_tone_at(appearance).x(), dark_hair_tone(appearance).x());
    appearance.grey_hair = 1;
    EXPECT_EQ(white_share_of_beard(appearance), 1);
    EXPECT_EQ(dark_hair_tone(appearance), Vec3(0.10, 0.08, 0.07)) << "whatever is white";
}

}  // namespace
}  // namespace risorius::render
