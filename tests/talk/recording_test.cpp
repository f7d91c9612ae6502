// SPDX-License-Identifier: MIT
// Recordings of a text, aligned with what a voice says. The recordings are those of another voice, whose times are known.
#include "risorius/talk/recording.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "message_of.h"
#include "paths.h"
#include "risorius/media/mono_sound.h"
#include "risorius/talk/spoken_input.h"
#include "temporary_folder.h"

namespace risorius::talk {
namespace {

const speech::PhoneTable& known_phones() {
    static const speech::PhoneTable one = speech::PhoneTable::read_folder(
        std::filesystem::path(RISORIUS_SOURCE_DIR) / "rigs/standard");
    return one;
}

const char* const kSaid = "Kissa istui ikkunalla ja katsoi lintuja pihalla.";

class Recordings : public testing::Test {
  protected:
    void SetUp() override {
        try {
            truth_ =
                speak({.text = kSaid, .language = "fi", .program = "festival"}, known_phones());
            speak({.text = "a", .language = "fi", .program = "espeak"}, known_phones());
        } catch (const Error&) {
            GTEST_SKIP() << "festival with suopuhe and espeak-ng are not both installed";
        }
        media::write_mono_wav({truth_.utterance.rate_hz, truth_.sound}, file_);
    }
    AlignedRecording aligned(const std::string& text, const std::string& language) const {
        return align_recording(file_, {.text = text, .language = language, .program = "espeak"},
                               known_phones());
    }
    TemporaryFolder folder_;
    const std::filesystem::path file_ = folder_ / "anna.wav";
    Spoken truth_;
};

TEST_F(Recordings, AreAlignedAcrossVoices) {
    const AlignedRecording found = aligned(kSaid, "fi");
    const speech::Utterance& utterance = found.alignment.utterance;
    ASSERT_EQ(utterance.words.size(), truth_.utterance.words.size());
    // Where words begin: half of the borders were within 12 ms when this was measured, with seven sentences.
    std::vector<double> errors_s;
    for (std::size_t i = 0; i < utterance.words.size(); ++i) {
        EXPECT_EQ(utterance.words[i].text, truth_.utterance.words[i].text);
        errors_s.push_back(std::abs(utterance.seconds(utterance.words[i].start) -
                                    truth_.utterance.seconds(truth_.utterance.words[i].start)));
    }
    std::sort(errors_s.begin(), errors_s.end());
    EXPECT_LT(errors_s[errors_s.size() / 2], 0.025);
    EXPECT_LT(errors_s.back(), 0.08);
    const std::string report = alignment_report(found.alignment);
    EXPECT_EQ(report.substr(0, report.find('\n')), "kind\tstart_s\tend_s\ttext\tmisfit\tdoubtful");
    EXPECT_NE(report.find("\tkatsoi\t"), std::string::npos);
}

TEST_F(Recordings, OfAnotherTextOrLanguageAreRefused) {
    for (const auto& [text, language] :
         {std::pair{"My mother bought five blue papers before breakfast.", "en-us"},
          std::pair{"Tänään sataa vettä ja tuuli puhaltaa kovaa pohjoisesta.", "fi"}})
        EXPECT_NE(message_of([&] {
                      aligned(text, language);
                  }).find("anna.wav: expected a recording of this text in "),
                  std::string::npos)
            << text;
    EXPECT_NE(message_of([&] { aligned("Kissa.", "fi"); }).find("s of speech for this text"),
              std::string::npos);
}

TEST_F(Recordings, AreSpokenWithTheirOwnSound) {
    SpokenInput input;
    input.voice = {.text = kSaid, .language = "fi", .program = "espeak"};
    input.audio = file_;
    const SpokenResult result = read_spoken(input, known_phones());
    EXPECT_EQ(result.sound_file, file_);
    EXPECT_EQ(result.spoken.utterance.samples, static_cast<std::int64_t>(truth_.sound.size()));
    EXPECT_EQ(result.spoken.utterance.sound, file_);
}

}  // namespace
}  // namespace risorius::talk
