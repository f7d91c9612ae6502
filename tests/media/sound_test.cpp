// SPDX-License-Identifier: MIT
// Sound is stored with a video and read back: every sample is at its place, with the precision of each format.
#include "risorius/media/detail/sound.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "media/pictures.h"
#include "risorius/core/error.h"
#include "risorius/media/video_reader.h"
#include "risorius/media/video_writer.h"

namespace risorius::media {
namespace {

void put_number(std::string& bytes, std::uint32_t value, int count) {
    for (int i = 0; i < count; ++i) bytes.push_back(static_cast<char>(value >> (8 * i) & 0xff));
}

/// A WAV file of 16-bit samples, written by hand (RIFF WAVE, format 1), independent of the reader.
std::string wav_bytes(const std::vector<std::int16_t>& samples, int rate_hz, int channels = 1) {
    const auto size = static_cast<std::uint32_t>(2 * samples.size());
    std::string out = "RIFF";
    put_number(out, 36 + size, 4);
    out += "WAVEfmt ";
    put_number(out, 16, 4);
    put_number(out, 1, 2);
    put_number(out, static_cast<std::uint32_t>(channels), 2);
    put_number(out, static_cast<std::uint32_t>(rate_hz), 4);
    put_number(out, static_cast<std::uint32_t>(rate_hz * channels * 2), 4);
    put_number(out, static_cast<std::uint32_t>(channels * 2), 2);
    put_number(out, 16, 2);
    out += "data";
    put_number(out, size, 4);
    for (const std::int16_t sample : samples)
        put_number(out, static_cast<std::uint16_t>(sample), 2);
    return out;
}

void write_bytes(const std::filesystem::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
}

/// A click whose position survives codecs: 2 ms of a windowed 3 kHz tone, with its middle at `at`.
std::vector<std::int16_t> click(int length, int at, int rate_hz) {
    std::vector<std::int16_t> out(static_cast<std::size_t>(length), 0);
    const int half = rate_hz / 1000;
    for (int i = -half; i <= half; ++i) {
        const double window = 0.5 + 0.5 * std::cos(M_PI * i / half);
        out[static_cast<std::size_t>(at + i)] = static_cast<std::int16_t>(
            std::lround(30000 * window * std::cos(2 * M_PI * 3000.0 * i / rate_hz)));
    }
    return out;
}

/// Time at which a click sounds, s, by time stamps and samples: the shift that fits best (cross-correlation with the click).
double click_time_s(const Sound& heard) {
    const int half = heard.rate_hz / 1000;
    const std::vector<std::int16_t> shape = click(2 * half + 1, half, heard.rate_hz);
    double max = 0;
    std::int64_t at = -1;
    for (std::int64_t i = half; i + half < heard.length(); ++i) {
        double sum = 0;
        for (int k = -half; k <= half; ++k)
            sum += shape[static_cast<std::size_t>(k + half)] *
                   static_cast<double>(
                       heard.samples[static_cast<std::size_t>((i + k) * heard.channels)]);
        if (sum > max) {
            max = sum;
            at = i;
        }
    }
    return heard.start_s + static_cast<double>(at) / heard.rate_hz;
}

Image grey_frame(int value) { return flat(kWidth, kHeight, value, value, value); }

/// One second at 50 fps that is white only in frame 20, with the recording's click at 0.4 s.
void write_flash_and_click(const std::filesystem::path& target, int rate_hz) {
    const TemporaryFolder folder;
    // 0.15 s into the recording, which begins 0.25 s after the video.
    write_bytes(folder / "click.wav",
                wav_bytes(click(rate_hz / 4, 15 * rate_hz / 100, rate_hz), rate_hz));
    VideoOptions options{.width_px = kWidth, .height_px = kHeight, .fps = 50};
    options.sound = std::make_shared<Sound>(read_recording(folder / "click.wav"));
    options.sound_offset_samples = rate_hz / 4;
    VideoWriter writer(target, options);
    for (int n = 0; n < 50; ++n) writer.append(grey_frame(n == 20 ? 235 : 16));
    writer.finish();
}

int flash_frame(const std::filesystem::path& file) {
    VideoReader video(file);
    EXPECT_EQ(video.frames(), 50);
    int at = -1;
    for (int n = 0; n < video.frames(); ++n)
        if (video.frame(n).pixel(30, 30)[1] > 200) {
            EXPECT_EQ(at, -1) << "a second flash";
            at = n;
        }
    EXPECT_NEAR(video.time_s(at), 0.4, 0.5e-3);
    return at;
}

TEST(Sound, FlashAndClickComeTogetherToTheSampleInPcm) {
    for (const char* name : {"a.mkv", "a.mov"})
        for (const int rate_hz : {44100, 48000}) {
            const TemporaryFolder folder;
            write_flash_and_click(folder / name, rate_hz);
            EXPECT_EQ(flash_frame(folder / name), 20);
            const Sound heard = read_sound(folder / name);
            EXPECT_EQ(heard.rate_hz, rate_hz);
            EXPECT_EQ(heard.length(), rate_hz) << "the length of the video";
            EXPECT_EQ(std::lround(click_time_s(heard) * rate_hz), 2 * rate_hz / 5) << name;
        }
}

TEST(Sound, FlashAndClickComeTogetherToAMillisecondInAacAndOpus) {
    for (const char* name : {"a.mp4", "a.webm"})
        for (const int rate_hz : {44100, 48000}) {
            const TemporaryFolder folder;
            write_flash_and_click(folder / name, rate_hz);
            EXPECT_EQ(flash_frame(folder / name), 20);
            const double time_s = click_time_s(read_sound(folder / name));
            EXPECT_NEAR(time_s, 0.4, 1e-3) << name << " from " << rate_hz << " Hz";
            RecordProperty(name + std::to_string(rate_hz), std::to_string(1e6 * (time_s - 0.4)));
        }
}

TEST(Sound, PcmIsTheRecordingBitForBitBetweenSilences) {
    const TemporaryFolder folder;
    std::vector<std::int16_t> noise_samples;
    std::uint32_t state = 7;
    for (int i = 0; i < 2 * 3000; ++i) {
        state = state * 1664525u + 1013904223u;
        noise_samples.push_back(static_cast<std::int16_t>(state >> 16));
    }
    write_bytes(folder / "noise.wav", wav_bytes(noise_samples, 32000, /*channels=*/2));
    VideoOptions options{.width_px = kWidth, .height_px = kHeight, .fps = 30};
    options.sound = std::make_shared<Sound>(read_recording(folder / "noise.wav"));
    for (const char* name : {"a.mkv", "a.mov"})
        for (const std::int64_t offset : {-1001, 0, 777}) {
            options.sound_offset_samples = offset;
            VideoWriter writer(folder / name, options);
            for (int n = 0; n < 3; ++n) writer.append(grey_frame(60));
            writer.finish();
            const Sound heard = read_sound(folder / name);
            ASSERT_EQ(heard.channels, 2);
            ASSERT_EQ(heard.length(), 3200) << "3 frames of 30 a second";
            for (std::int64_t i = 0; i < 3200; ++i)
                for (int c = 0; c < 2; ++c) {
                    const std::int64_t from = i - offset;
                    const float expected =
                        from < 0 || from >= 3000
                            ? 0.0f
                            : static_cast<float>(
                                  noise_samples[static_cast<std::size_t>(2 * from + c)]) /
                                  32768.0f;
                    ASSERT_EQ(heard.samples[static_cast<std::size_t>(2 * i + c)], expected)
                        << name << " offset " << offset << " sample " << i;
                }
        }
}

TEST(Sound, VideosWithSoundAreTheSameBytesAgain) {
    const TemporaryFolder folder;
    for (const std::string ending : {".mp4", ".mkv", ".mov", ".webm"}) {
        write_flash_and_click(folder / ("a" + ending), 48000);
        write_flash_and_click(folder / ("b" + ending), 48000);
        EXPECT_TRUE(bytes_of(folder / ("a" + ending)) == bytes_of(folder / ("b" + ending)))
            << ending;
    }
}

TEST(Sound, AtAnotherRateEverySampleKeepsItsTime) {
    const TemporaryFolder folder;
    write_bytes(folder / "click.wav", wav_bytes(click(22050, 9000, 44100), 44100));
    const Sound heard = resampled(read_recording(folder / "click.wav"), 48000);
    EXPECT_EQ(heard.length(), 24000);
    EXPECT_NEAR(click_time_s(heard), 9000.0 / 44100, 0.6 / 48000);
}

TEST(Sound, NamesWhatIsWrongWithAFile) {
    const TemporaryFolder folder;
    const auto message = [&](const std::string& name) -> std::string {
        try {
            read_recording(folder / name);
        } catch (const Error& error) {
            return std::string(error.what()).substr(folder.path().string().size() + 1);
        }
        return "no error";
    };
    EXPECT_EQ(message("a.wav"), "a.wav: expected a sound file, found no such file");
    write_bytes(folder / "text.wav", "words");
    EXPECT_EQ(message("text.wav"),
              "text.wav: expected a sound file, found another kind of file, or one cut short");
    const std::string whole = wav_bytes(click(4800, 2400, 48000), 48000);
    write_bytes(folder / "cut.wav", whole.substr(0, whole.size() / 2));
    EXPECT_EQ(message("cut.wav"),
              "cut.wav: expected as much sound as its header says, found 4822 bytes less");
    VideoWriter writer(folder / "mute.mkv", {.width_px = kWidth, .height_px = kHeight});
    writer.append(grey_frame(9));
    writer.finish();
    EXPECT_EQ(message("mute.mkv"), "mute.mkv: expected a file with sound, found none in it");
}

}  // namespace
}  // namespace risorius::media
