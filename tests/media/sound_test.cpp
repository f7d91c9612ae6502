// SPDX-License-Identifier: MIT
// Sound is stored with a video and read back: every sample is at its place, with the precision of each format.
#include "risorius/media/detail/sound.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <cstring>

#include "media/pictures.h"
#include "message_of.h"
#include "risorius/core/error.h"
#include "risorius/media/mono_sound.h"
#include "risorius/media/video_reader.h"
#include "risorius/media/video_writer.h"

namespace risorius::media {
namespace {

namespace fs = std::filesystem;

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

/// The recording at another rate, read in blocks.
Sound resampled(const Recording& recording, int rate_hz, std::int64_t block) {
    ResampledRecording stream(recording, rate_hz);
    Sound out;
    out.rate_hz = rate_hz;
    out.channels = recording.channels;
    out.samples.resize(static_cast<std::size_t>(stream.length() * out.channels));
    for (std::int64_t at = 0; at < stream.length(); at += block)
        stream.read(at, std::min(block, stream.length() - at),
                    out.samples.data() + at * out.channels);
    return out;
}

/// A message without the path of the folder in front.
std::string without_folder(const std::string& message, const TemporaryFolder& folder) {
    const std::string path = folder.path().string() + "/";
    return message.starts_with(path) ? message.substr(path.size()) : message;
}

/// Greatest memory that this process has used, kB.
long peak_memory_kB() {
    struct ::rusage usage {};
    ::getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
}

Image grey_frame(int value) { return flat(kWidth, kHeight, value, value, value); }

/// One second at 50 fps that is white only in frame 20, with the recording's click at 0.4 s.
void write_flash_and_click(const std::filesystem::path& target, int rate_hz) {
    const TemporaryFolder folder;
    // 0.15 s into the recording, which begins 0.25 s after the video.
    write_bytes(folder / "click.wav",
                wav_bytes(click(rate_hz / 4, 15 * rate_hz / 100, rate_hz), rate_hz));
    VideoOptions options{.width_px = kWidth, .height_px = kHeight, .fps = 50};
    options.sound = std::make_shared<Recording>(open_recording(folder / "click.wav"));
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
    options.sound = std::make_shared<Recording>(open_recording(folder / "noise.wav"));
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
    const Recording recording = open_recording(folder / "click.wav");
    const Sound heard = resampled(recording, 48000, 24000);
    EXPECT_EQ(heard.length(), 24000);
    EXPECT_NEAR(click_time_s(heard), 9000.0 / 44100, 0.6 / 48000);
    for (const std::int64_t block : {1, 1024, 5000})
        EXPECT_EQ(resampled(recording, 48000, block).samples, heard.samples) << block;
    // Silence before and after
    ResampledRecording stream(recording, 48000);
    std::vector<float> samples(30);
    stream.read(-10, 20, samples.data());
    EXPECT_EQ(samples[15], heard.samples[5]);
    stream.read(23990, 30, samples.data());
    EXPECT_EQ(samples[9], heard.samples[23999]);
    EXPECT_EQ(samples[10], 0);
}

/// A WAV file of one channel at 48 kHz, by its format and the bytes of its samples. `length` is what the header says.
std::string wav_of(int tag, int bits, const std::string& data, std::uint32_t length,
                   int valid_bits = 0) {
    std::string out = "RIFF", format;
    put_number(format, valid_bits > 0 ? 0xfffe : static_cast<std::uint32_t>(tag), 2);
    put_number(format, 1, 2);
    put_number(format, 48000, 4);
    put_number(format, static_cast<std::uint32_t>(48000 * bits / 8), 4);
    put_number(format, static_cast<std::uint32_t>(bits / 8), 2);
    put_number(format, static_cast<std::uint32_t>(bits), 2);
    if (valid_bits > 0) {  // WAVE_FORMAT_EXTENSIBLE
        put_number(format, 22, 2);
        put_number(format, static_cast<std::uint32_t>(valid_bits), 2);
        put_number(format, 4, 4);
        put_number(format, static_cast<std::uint32_t>(tag), 2);
        format += std::string("\0\0\0\0\x10\0\x80\0\0\xaa\0\x38\x9b\x71", 14);
    }
    put_number(out, static_cast<std::uint32_t>(20 + format.size() + data.size()), 4);
    out += "WAVEfmt ";
    put_number(out, static_cast<std::uint32_t>(format.size()), 4);
    out += format + "data";
    put_number(out, length, 4);
    return out + data;
}

/// The bytes of numbers, little-endian.
template <class Number>
std::string bytes_of_numbers(const std::vector<Number>& numbers) {
    std::string out(numbers.size() * sizeof(Number), '\0');
    std::memcpy(out.data(), numbers.data(), out.size());
    return out;
}

TEST(Sound, EveryKindOfIntegerIsReadAtItsLevel) {
    const TemporaryFolder folder;
    const auto read = [&](const std::string& bytes) {
        write_bytes(folder / "a.wav", bytes);
        return part_of(open_recording(folder / "a.wav"), 0, 3);
    };
    const std::vector<float> expected{0.5f, -0.25f, 1.0f / 128};
    const std::vector<std::int32_t> wide{1 << 30, -(1 << 29), 1 << 24};
    const std::vector<std::int64_t> long_ones{std::int64_t{1} << 62, -(std::int64_t{1} << 61),
                                              std::int64_t{1} << 56};
    const std::string of_32 = bytes_of_numbers(wide);
    EXPECT_EQ(read(wav_of(1, 32, of_32, 12)).samples, expected);
    const Sound in_container = read(wav_of(1, 32, of_32, 12, /*valid_bits=*/24));
    EXPECT_EQ(in_container.samples, expected) << "24 bits in 32: was +632 dB";
    EXPECT_EQ(in_container.bits, 24);
    EXPECT_EQ(
        read(wav_of(1, 16, bytes_of_numbers<std::int16_t>({16384, -8192, 256}), 6, 12)).samples,
        expected);
    EXPECT_EQ(read(wav_of(1, 64, bytes_of_numbers(long_ones), 24)).samples, expected);
    EXPECT_EQ(read(wav_of(3, 32, bytes_of_numbers<float>(expected), 12)).samples, expected);
    EXPECT_EQ(read(wav_of(3, 64, bytes_of_numbers<double>({0.5, -0.25, 1.0 / 128}), 24)).samples,
              expected);
}

TEST(Sound, LengthsOfProgramsThatWriteIntoAPipeAreUnknown) {
    const TemporaryFolder folder;
    const std::string data = bytes_of_numbers<std::int16_t>({1, 2, 3});
    for (const std::uint32_t length : {0u, 0xffffffffu, 0x7fffffffu, 0x7ffff000u}) {
        write_bytes(folder / "a.wav", wav_of(1, 16, data, length));
        EXPECT_EQ(open_recording(folder / "a.wav").length(), 3) << length;
    }
}

TEST(Sound, SamplesThatAreNoSoundAreRefused) {
    const TemporaryFolder folder;
    const auto message = [&](const std::string& bytes) {
        write_bytes(folder / "a.wav", bytes);
        return without_folder(message_of([&] { open_recording(folder / "a.wav"); }), folder);
    };
    const auto of_floats = [](float value) {
        return wav_of(3, 32, bytes_of_numbers<float>({0, value}), 8);
    };
    const std::string expected =
        "a.wav: at 2.0833333333333333e-05 s: expected samples of at most 24 dB above full scale, "
        "found ";
    EXPECT_EQ(message(of_floats(NAN)), expected + "NaN");
    EXPECT_EQ(message(of_floats(-HUGE_VALF)), expected + "-inf of full scale");
    EXPECT_EQ(message(of_floats(100)), expected + "100 of full scale");
    EXPECT_EQ(message(of_floats(2)), "no error") << "floating point may exceed full scale";
    EXPECT_EQ(message(wav_of(3, 64, bytes_of_numbers<double>({0, 1e300}), 16)),
              expected + "1e+300 of full scale");
}

TEST(Sound, OfAnHourCostsNoMemory) {
    const TemporaryFolder folder;
    const fs::path file = folder / "hour.wav";
    constexpr std::uint32_t kSamples = 3600u * 48000u;
    write_bytes(file, wav_of(1, 16, "", 2 * kSamples));
    fs::resize_file(file, fs::file_size(file) + 2 * kSamples);  // zeros that take no disk
    const long before_kB = peak_memory_kB();
    const Recording recording = open_recording(file);
    EXPECT_EQ(recording.length(), kSamples);
    ResampledRecording stream(recording, 44100);
    std::vector<float> samples(1000);
    stream.read(stream.length() - 1000, 1000, samples.data());
#ifdef __SANITIZE_ADDRESS__
    constexpr long kMost_kB = 450'000;  // the sanitizer keeps 256 MB of what was freed
#else
    constexpr long kMost_kB = 20'000;
#endif
    EXPECT_LT(peak_memory_kB() - before_kB, kMost_kB) << "it was 700 MB and more";
}

TEST(Sound, OfDaysIsRefusedBeforeItIsDecoded) {
    const TemporaryFolder folder;
    const fs::path file = folder / "days.wav";
    constexpr std::uint32_t kBytes = 4'000'000'400u;
    write_bytes(file, wav_of(1, 16, "", kBytes));
    fs::resize_file(file, fs::file_size(file) + kBytes);  // zeros that take no disk
    EXPECT_EQ(
        without_folder(message_of([&] { open_recording(file); }), folder),
        "days.wav: expected at most 2e9 samples in all channels, six hours in stereo, found more");
}

TEST(Sound, InMemoryHasALimit) {
    const TemporaryFolder folder;
    write_bytes(folder / "a.wav", wav_of(1, 16, std::string(20, '\1'), 20));
    EXPECT_EQ(read_mono_sound(folder / "a.wav", 10).samples.size(), 10u);
    EXPECT_EQ(without_folder(message_of([&] { read_mono_sound(folder / "a.wav", 9); }), folder),
              "a.wav: expected at most 9 samples in each channel, found 10");
    EXPECT_EQ(sound_rate_hz(folder / "a.wav"), read_mono_sound(folder / "a.wav").rate_hz);
}

TEST(Sound, NamesWhatIsWrongWithAFile) {
    const TemporaryFolder folder;
    const auto message = [&](const std::string& name) {
        return without_folder(message_of([&] { open_recording(folder / name); }), folder);
    };
    EXPECT_EQ(message("a.wav"), "a.wav: expected a sound file, found no such file");
    write_bytes(folder / "text.wav", "words");
    EXPECT_EQ(message("text.wav"),
              "text.wav: expected a sound file, found another kind of file, or one cut short");
    const std::string whole = wav_bytes(click(4800, 2400, 48000), 48000);
    write_bytes(folder / "whole.wav", whole);
    write_bytes(folder / "list.wav", "ffconcat version 1.0\nfile whole.wav\n");
    EXPECT_EQ(message("list.wav"),
              "list.wav: expected a sound file, found another kind of file, or one cut short");
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
