// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "risorius/speech/phone_table.h"
#include "risorius/speech/windows.h"
#include "risorius/talk/detail/check_speech.h"

namespace risorius::talk {
namespace {

TEST(CheckVowels, OnesThatOpenTooLittleAreAskedForMoreAndClosuresKeepTheirChanges) {
    const std::vector<speech::ClosureChange> before{{.phone = 2, .deeper_mm = 1}};
    const auto after = widened({{1, 9, 8.5}, {4, 9, 5}, {6, 20, 0}}, before);
    ASSERT_EQ(after.size(), 3u);
    EXPECT_EQ(after[0].deeper_mm, 1);
    EXPECT_EQ(after[1].phone, 4);
    EXPECT_NEAR(after[1].wider_mm, 0.8 * 4, 1e-12);
    EXPECT_EQ(after[2].wider_mm, 6);
}

TEST(CheckVowels, AWiderVowelChangesItsGapAlone) {
    speech::ArticulationTargets targets{0, 1, {}, {}, {}, {}};
    targets.windows = {{speech::Parameter::kGap, 0.1, 0.2, 8, 0.03, false, 4},
                       {speech::Parameter::kJaw, 0.1, 0.2, 6, 0.03, false, 4},
                       {speech::Parameter::kGap, 0.3, 0.4, 8, 0.03, false, 5}};
    speech::change_closures({{.phone = 4, .wider_mm = 2}}, targets);
    EXPECT_EQ(targets.windows[0].target, 10);
    EXPECT_EQ(targets.windows[1].target, 6);
    EXPECT_EQ(targets.windows[2].target, 8);
}

TEST(CheckVowels, TheLipIsAtTheTeethWhenFBegins) {
    speech::Utterance said;
    said.rate_hz = 1000;
    for (const auto& [symbol, from, to] :
         {std::tuple{"ɑ", 400, 600}, std::tuple{"f", 600, 700}, std::tuple{"ɑ", 700, 900}}) {
        speech::Phone phone;
        phone.symbol = symbol;
        phone.start = from;
        phone.end = to;
        said.phones.push_back(phone);
    }
    said.samples = 900;
    const auto targets = speech::targets_of(said, speech::PhoneTable::standard());
    ASSERT_EQ(targets.contacts.size(), 1u);
    EXPECT_LT(targets.contacts[0].from_s, 0.6);
    EXPECT_GT(targets.contacts[0].to_s, 0.67);
}

}  // namespace
}  // namespace risorius::talk
