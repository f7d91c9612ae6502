// SPDX-License-Identifier: MIT
// Compared with the signals of EBU Tech 3341 (2016), table 1, whose loudness is published.
#include "risorius/media/loudness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "risorius/media/wav_file.h"
#include "temporary_folder.h"

namespace risorius::media {
namespace {

/// Lengths are a quarter of those in the tables. Except at the borders the blocks are the same, and the test takes a quarter of
/// the time.
constexpr double kShorter = 4;

/// Both channels are equal: pieces of a sine of 1 kHz, given by level in dBFS and length in s before it is shortened.
Sound tones(const std::vector<std::pair<double, double>>& pieces) {
    Sound out;
    out.channels = 2;
    for (const auto& [level_db, length_s] : pieces)
        for (int i = 0; i < static_cast<int>(length_s / kShorter * out.rate_hz); ++i) {
            const double t_s = static_cast<double>(out.samples.size() / 2) / out.rate_hz;
            const auto value = static_cast<float>(std::pow(10, level_db / 20) *
                                                  std::sin(2000 * std::numbers::pi * t_s));
            out.samples.insert(out.samples.end(), {value, value});
        }
    return out;
}

double lufs(const std::vector<std::pair<double, double>>& pieces) {
    return loudness_of(tones(pieces)).integrated_lufs;
}

TEST(Loudness, IsThatOfThePublishedSignals) {
    EXPECT_NEAR(lufs({{-23, 20}}), -23, 0.1);                        // 1
    EXPECT_NEAR(lufs({{-33, 20}}), -33, 0.1);                        // 2
    EXPECT_NEAR(lufs({{-36, 10}, {-23, 60}, {-36, 10}}), -23, 0.1);  // 3: relative gate
    EXPECT_NEAR(lufs({{-72, 10}, {-36, 10}, {-23, 60}, {-36, 10}, {-72, 10}}), -23, 0.1);  // 4
    EXPECT_NEAR(lufs({{-26, 20}, {-20, 20.1}, {-26, 20}}), -23, 0.1);                      // 5
}

TEST(Loudness, FindsThePeakBetweenTheSamples) {
    // 16: a quarter of the rate, 60 degrees off, half of full scale. Every sample is below the peak of -6 dBTP.
    Sound sound;
    for (int i = 0; i < 48000; ++i)
        sound.samples.push_back(
            static_cast<float>(0.5 * std::sin(std::numbers::pi * (i / 2.0 + 1.0 / 3))));
    const double peak = loudness_of(sound).true_peak_dbtp;
    EXPECT_LT(peak, -6 + 0.2);
    EXPECT_GT(peak, -6 - 0.4);
}

TEST(Loudness, OfAFileGrowsWithTheGain) {
    const TemporaryFolder folder;
    Sound sound = tones({{-30, 20}});
    sound.bits = 32;
    write_wav(sound, folder / "a.wav");
    Recording recording = open_recording(folder / "a.wav");
    EXPECT_EQ(loudness_of(recording, 0, recording.length()).integrated_lufs,
              loudness_of(sound).integrated_lufs);
    recording.gain_db = 7;
    EXPECT_NEAR(loudness_of(recording, 0, recording.length()).integrated_lufs,
                lufs({{-30, 20}}) + 7, 1e-4);
}

TEST(Loudness, OfSilenceIsNone) {
    EXPECT_EQ(lufs({{-300, 10}}), -HUGE_VAL);
    EXPECT_EQ(lufs({{-20, 1.2}}), -HUGE_VAL) << "less than a block of 0.4 s";
}

TEST(WavFile, ReadsBackWhatWasWritten) {
    const TemporaryFolder folder;
    for (const int bits : {16, 24, 32}) {
        Sound sound;
        sound.rate_hz = 22050;
        sound.bits = bits;
        sound.channels = 3;
        sound.samples = {0, -1, 0.5f, 1 / 32768.0f, -0.25f, 0.75f, 0.125f, 0, 0};
        write_wav(sound, folder / "a.wav");
        const Sound back = read_sound(folder / "a.wav");
        EXPECT_EQ(back.samples, sound.samples) << bits;
        EXPECT_EQ(back.bits, bits);
        EXPECT_EQ(back.rate_hz, 22050);
    }
    Sound loud;
    loud.samples = {2, -2};
    write_wav(loud, folder / "a.wav");
    EXPECT_EQ(read_sound(folder / "a.wav").samples, (std::vector<float>{32767 / 32768.0f, -1}));
}

TEST(Heard, IsWhatLiesWithinTheVideo) {
    const TemporaryFolder folder;
    Sound sound;
    sound.rate_hz = 8000;
    sound.bits = 32;
    sound.samples = {1, 2, 3, 4};
    write_wav(sound, folder / "a.wav");
    const Recording recording = open_recording(folder / "a.wav");
    EXPECT_EQ(part_of(recording, 2, 5).samples, (std::vector<float>{0, 0, 1, 2, 3}));
    EXPECT_EQ(part_of(recording, -3, 3).samples, (std::vector<float>{4, 0, 0}));
    EXPECT_EQ(part_of(recording, 9, 2).samples, (std::vector<float>{0, 0}));
    EXPECT_EQ(part_of(recording, -9, 2).samples, (std::vector<float>{0, 0}));
    EXPECT_EQ(part_of(recording, -1, 9000).length(), 9000);
}

}  // namespace
}  // namespace risorius::media
