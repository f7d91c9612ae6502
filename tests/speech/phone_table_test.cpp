// SPDX-License-Identifier: MIT
#include "risorius/speech/phone_table.h"

#include <gtest/gtest.h>

#include "message_of.h"
#include "paths.h"

namespace risorius::speech {
namespace {

const PhoneTable& table() {
    static const PhoneTable one =
        PhoneTable::read_folder(std::filesystem::path(RISORIUS_SOURCE_DIR) / "rigs/standard");
    return one;
}

/// "p:0.45 ʃː'" for a label: symbol, length, stress.
std::string split(const std::string& label, const std::string& set = "ipa") {
    std::string out;
    for (const SplitPhone& part : table().split(label, set, "here"))
        out += (out.empty() ? "" : " ") + part.symbol + (part.length_mark == 2 ? ":" : "") +
               (part.stress == 2 ? "'" : "");
    return out;
}

TEST(PhoneTable, HasAClassAndAVisemeForEverySymbol) {
    EXPECT_GE(table().phones().size(), 119u);
    for (const PhoneEntry& phone : table().phones()) EXPECT_FALSE(phone.viseme.empty());
    EXPECT_EQ(table().phone("p", "here").kind, PhoneClass::kClosure);
    EXPECT_LT(value_of(table().phone("m", "here").target, Parameter::kGap), 0);
}

TEST(PhoneTable, MarksChangeTheTarget) {
    const PhoneEntry k = table().phone("k", "here"), kw = table().phone("kʷ", "here");
    EXPECT_DOUBLE_EQ(value_of(kw.target, Parameter::kProtrusion),
                     value_of(k.target, Parameter::kProtrusion) + 3);
    EXPECT_EQ(kw.symbol, "kʷ");
    // A closure stays closed, whatever its marks say.
    EXPECT_DOUBLE_EQ(value_of(table().phone("pʷ", "here").target, Parameter::kGap),
                     value_of(table().phone("p", "here").target, Parameter::kGap));
}

TEST(PhoneTable, SplitsWhatSynthesisersAndAlignersWrite) {
    EXPECT_EQ(split("oːɹ"), "o: ɹ");
    EXPECT_EQ(split("aɪ"), "a ɪ");
    EXPECT_EQ(split("æi"), "æ i");
    EXPECT_EQ(split("t͡ʃ"), "t ʃ");
    EXPECT_EQ(split("ʧ"), "t ʃ");
    EXPECT_EQ(split("ˈpʰaː"), "pʰ' a:");
    EXPECT_EQ(split("g"), "ɡ");
    EXPECT_EQ(split("ts.", "espeak"), "ʈ ʂ");
    EXPECT_EQ(split("AH1", "arpabet"), "ʌ'");
    EXPECT_EQ(split("CH", "arpabet"), "t ʃ");
    EXPECT_EQ(split("{", "xsampa"), "æ");
    EXPECT_EQ(split("t_h", "xsampa"), "tʰ");
    EXPECT_EQ(split("öö", "finnish"), "ø:");
    EXPECT_EQ(split("oh", "oculus"), "o");
    for (const char* silence : {"", "sil", "sp", "<eps>", "pau"}) EXPECT_EQ(split(silence), "_");
}

TEST(PhoneTable, SharesOfALabelAddUpToOne) {
    const auto diphthong = table().split("aɪ", "ipa", "here");
    EXPECT_DOUBLE_EQ(diphthong[0].share, 0.55);
    const auto affricate = table().split("tʃ", "ipa", "here");
    EXPECT_DOUBLE_EQ(affricate[0].share, 0.45);
    double sum = 0;
    for (const SplitPhone& part : table().split("oːɹtʃ", "ipa", "here")) sum += part.share;
    EXPECT_NEAR(sum, 1, 1e-15);
}

TEST(PhoneTable, NamesTheNearestSymbolOfAnUnknownOne) {
    EXPECT_EQ(message_of([] { table().split("ȹ", "ipa", "a.TextGrid:12"); }),
              "a.TextGrid:12: expected a symbol of the set \"ipa\" (the nearest is \"ɹ\"), found "
              "\"ȹ\"");
    EXPECT_EQ(message_of([] { table().split("AHH", "arpabet", "a.ctm:3"); }),
              "a.ctm:3: expected a symbol of the set \"arpabet\" (the nearest is \"AH\"), found "
              "\"AHH\"");
    EXPECT_NE(message_of([] { table().split("a", "ipaa", "x"); }).find("did you mean \"ipa\""),
              std::string::npos);
}

}  // namespace
}  // namespace risorius::speech
