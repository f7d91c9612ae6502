// SPDX-License-Identifier: MIT
/// \file
/// Sound of one channel in memory, for measurements.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace risorius::media {

struct MonoSound {
    int rate_hz = 48000;
    std::vector<float> samples;  ///< 1 = full scale
};

/// Half a gigabyte with a copy for each step of the work: 34 minutes at 48 kHz.
inline constexpr std::int64_t kMostMonoSamples = 100'000'000;

/// Reads a WAV or FLAC file; several channels are averaged. Throws Error as open_recording() does, and when a channel has more than
/// `most` samples.
MonoSound read_mono_sound(const std::filesystem::path& file, std::int64_t most = kMostMonoSamples);

/// Samples per second of a WAV or FLAC file, which takes no memory. Throws Error as open_recording() does.
int sound_rate_hz(const std::filesystem::path& file);

/// Writes 16-bit samples. Throws RunError.
void write_mono_wav(const MonoSound& sound, const std::filesystem::path& file);

}  // namespace risorius::media
