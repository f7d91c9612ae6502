// SPDX-License-Identifier: MIT
#include "risorius/speech/prosody.h"

#include <gtest/gtest.h>

#include "speech/curve_helpers.h"

namespace risorius::speech {
namespace {

Utterance two_words() {
    Utterance u = utterance_of({{"m", .08},
                                {"ɑ", .12},
                                {"t", .08},
                                {"o", .1},
                                {"_", .5},
                                {"p", .09},
                                {"u", .1},
                                {"r", .06},
                                {"o", .1}});
    u.phones[2].stress = u.phones[7].stress = 2;
    u.words = {{"mato", u.phones[1].start, u.phones[4].end},
               {"puro", u.phones[6].start, u.phones[9].end}};
    return u;
}

TEST(Prosody, NothingMovesUnlessAsked) {
    const Prosody none = prosody_of(two_words(), standard_phones(), {});
    EXPECT_TRUE(none.gestures.empty());
    EXPECT_TRUE(none.blinks_s.empty());
}

TEST(Prosody, BrowsLeadAndTheHeadFollows) {
    const Prosody p = prosody_of(two_words(), standard_phones(), {.gestures = 1});
    ASSERT_FALSE(p.gestures.empty());
    const Gesture& brow = p.gestures[0];
    ASSERT_EQ(brow.kind, Gesture::Kind::kBrow);
    EXPECT_NEAR(brow.start_s, 0.4 - 0.1, 1e-3);
    EXPECT_NEAR(brow.at(brow.peak_s), 0.35, 1e-9);
    EXPECT_EQ(brow.at(brow.start_s), 0);
    EXPECT_EQ(brow.at(brow.end_s), 0);
    for (const Gesture& gesture : p.gestures)
        if (gesture.kind == Gesture::Kind::kNod) {
            EXPECT_GT(gesture.start_s, brow.start_s);
        }
}

TEST(Prosody, BlinksKeepAwayFromBurstsAndDependOnTheSeedAlone) {
    Utterance u = two_words();
    const Prosody one = prosody_of(u, standard_phones(), {.blinks = 2, .seed = 5}),
                  two = prosody_of(u, standard_phones(), {.blinks = 2, .seed = 5});
    EXPECT_EQ(one.blinks_s, two.blinks_s);
    EXPECT_FALSE(one.blinks_s.empty());
    for (const double blink_s : one.blinks_s)
        for (const Phone& phone : u.phones)
            if (phone.release) {
                const double burst_s = u.seconds(*phone.release);
                EXPECT_FALSE(burst_s > blink_s - 0.1 && burst_s < blink_s + 0.32);
            }
}

}  // namespace
}  // namespace risorius::speech
