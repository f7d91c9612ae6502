// SPDX-License-Identifier: MIT
#include "risorius/talk/voice.h"

#include <gtest/gtest.h>

#include "message_of.h"
#include "paths.h"
#include "risorius/core/data_folder.h"
#include "risorius/talk/detail/voice_table.h"
#include "risorius/talk/spoken_input.h"
#include "temporary_folder.h"

namespace risorius::talk {
namespace {

const speech::PhoneTable& phones() {
    static const speech::PhoneTable one = speech::PhoneTable::read_folder(
        std::filesystem::path(RISORIUS_SOURCE_DIR) / "rigs/standard");
    return one;
}

std::string listed(const speech::Utterance& utterance) {
    std::string out;
    for (const speech::Phone& phone : utterance.phones)
        out += (out.empty() ? "" : " ") + phone.text() + (phone.stress == 2 ? "'" : "") +
               std::to_string(phone.start);
    return out;
}

TEST(VoiceTable, LengthAndStressComeFromTheTextOfThePhones) {
    const std::string text =
        "kind\tsample\tchar_start\tchar_length\tsymbol\n"
        "sentence\t0\t1\t0\t\nword\t0\t1\t4\t\nphone\t0\t1\t0\tɑ\nphone\t4000\t1\t0\tp\n"
        "phone\t5000\t1\t0\tɑ\nword\t9000\t6\t2\t\nphone\t9000\t6\t0\taɪ\n"
        "phone\t13000\t0\t0\t\nend\t15000\t0\t0\t\nipa\t0\t0\t0\tˈɑpːɑ ˈaɪ\n# voice 1\n";
    const VoiceTable table = parse_voice_table(text, "voice");
    EXPECT_EQ(table.program, "voice 1");
    const speech::Utterance u =
        utterance_of_voice(table, "appa äy", {"espeak", {{"ɪ", "i"}}}, 22050, 15000, phones());
    EXPECT_EQ(listed(u), "ɑ'0 pː4000 ɑ5000 a'9000 i11200 _13000");
    ASSERT_EQ(u.words.size(), 2u);
    EXPECT_EQ(u.words[0].text, "appa");
    EXPECT_EQ(u.words[1].text, "äy");
    EXPECT_EQ(u.words[1].end, 13000);
    EXPECT_EQ(message_of([] { parse_voice_table("kind\nphone\t1\n", "voice"); }),
              "voice:1: expected kind, sample, char_start, char_length and symbol, found \"kind\"");
}

TEST(Voice, AMissingProgramIsToldWithItsPackage) {
    EXPECT_NE(message_of([] {
                  speak({.text = "a", .program = "none"}, phones());
              }).find("one of \"festival\" \"espeak\""),
              std::string::npos);
    EXPECT_NE(message_of([] { speak({.text = "a", .rate = 9}, phones()); }).find("[0.3, 3]"),
              std::string::npos);
    EXPECT_NE(message_of([] { speak({.text = ""}, phones()); }).find("found none"),
              std::string::npos);
}

// Lengths in samples of the voice at its own rate, measured once: a double consonant is about twice a single one.
TEST(Festival, SpeaksFinnishQuantity) {
    const auto length_of = [](const std::string& text, const std::string& symbol) {
        const Spoken spoken =
            speak({.text = text, .language = "fi", .program = "festival"}, phones());
        for (const speech::Phone& phone : spoken.utterance.phones)
            if (phone.symbol == symbol) return spoken.utterance.seconds(phone.end - phone.start);
        return 0.0;
    };
    double single = 0;
    try {
        single = length_of("rapu", "p");
    } catch (const Error&) {
        GTEST_SKIP() << "festival or festvox-suopuhe-lj is not installed";
    }
    const double twice = length_of("rappu", "p");
    EXPECT_GT(twice / single, 1.6);
    EXPECT_LT(twice / single, 2.4);
    EXPECT_NEAR(length_of("tuuli", "u") / length_of("tuli", "u"), 1.9, 0.4);
}

class Espeak : public testing::Test {
  protected:
    void SetUp() override {
        if (!std::filesystem::exists(code_folder() / "risorius-voice-espeak") &&
            !std::filesystem::exists(code_folder() / "../risorius-voice-espeak"))
            GTEST_SKIP() << "risorius-voice-espeak is not built (libespeak-ng-dev)";
    }
};

// espeak-ng counts the closures to the vowels before. The limits are those of the design, found by looking at the sound.
TEST_F(Espeak, ClosuresOfApaAndAppaAreFoundInTheSound) {
    for (const auto& [said, from_ms, to_ms] :
         {std::tuple{"'apa", 45.0, 50.0}, std::tuple{"'ap:a", 175.0, 185.0}}) {
        const Spoken spoken = speak({.phones = said, .language = "fi"}, phones());
        int stops = 0;
        for (const speech::Phone& phone : spoken.utterance.phones) {
            if (phone.symbol != "p") continue;
            ++stops;
            const double ms = 1e3 * spoken.utterance.seconds(*phone.release - *phone.closure);
            EXPECT_GE(ms, from_ms) << said;
            EXPECT_LE(ms, to_ms) << said;
        }
        EXPECT_EQ(stops, 1) << said;
    }
}

TEST_F(Espeak, SpeaksTheSameEveryTimeInSeveralLanguages) {
    for (const auto& [language, text] :
         {std::pair{"fi", "Pimeän metsän puro solisi, ja vanha mummo tapasi ystävän."},
          std::pair{"en-us", "My mother bought five blue papers before breakfast."},
          std::pair{"cs", "Příliš žluťoučký kůň úpěl ďábelské ódy."},
          std::pair{"de", "Zwölf Boxkämpfer jagen Viktor quer über den großen Sylter Deich."}}) {
        const Spoken one =
                         speak({.text = text, .language = language, .program = "espeak"}, phones()),
                     two =
                         speak({.text = text, .language = language, .program = "espeak"}, phones());
        EXPECT_EQ(speech::utterance_text(one.utterance), speech::utterance_text(two.utterance));
        EXPECT_EQ(one.sound, two.sound);
        speech::check_utterance(one.utterance, phones(), language);
        EXPECT_GT(one.utterance.phones.size(), 25u);
        EXPECT_GT(one.utterance.words.size(), 5u);
    }
}

}  // namespace
}  // namespace risorius::talk
