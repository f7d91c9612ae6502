// SPDX-License-Identifier: MIT
/// \file
/// Sound of one channel in memory, for measurements.
#pragma once

#include <filesystem>
#include <vector>

namespace risorius::media {

struct MonoSound {
    int rate_hz = 48000;
    std::vector<float> samples;  ///< 1 = full scale
};

/// Reads a WAV or FLAC file; several channels are averaged. Throws Error as open_recording() does.
MonoSound read_mono_sound(const std::filesystem::path& file);

/// Writes 16-bit samples. Throws RunError.
void write_mono_wav(const MonoSound& sound, const std::filesystem::path& file);

}  // namespace risorius::media
