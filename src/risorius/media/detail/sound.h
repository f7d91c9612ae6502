// SPDX-License-Identifier: MIT
/// \file
/// Sound in memory, read through the FFmpeg libraries: recordings for a video, or the sound of a video for measurements. The
/// delay of decoders (AAC's priming, Opus' pre-skip) is removed as the file states.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace risorius::media {

struct Sound {
    int rate_hz = 48000;
    int channels = 1;
    int bits = 16;       ///< per sample in the file: 16, 24, or 32 for floating point
    double start_s = 0;  ///< time of the first sample; Matroska and WebM round it to a millisecond
    std::string container;       ///< FFmpeg's name: "wav", "flac", "matroska,webm"
    std::vector<float> samples;  ///< interleaved, 1 = full scale; 16 and 24 bits are exact

    std::int64_t length() const {  ///< samples of one channel
        return static_cast<std::int64_t>(samples.size()) / channels;
    }
};

/// Throws Error when the file is missing, has no sound, or is shorter than its header says.
Sound read_sound(const std::filesystem::path& file);
/// Does the same, but accepts only WAV and FLAC.
Sound read_recording(const std::filesystem::path& file);

/// Converts sound to another sampling rate without a delay.
Sound resampled(const Sound& sound, int rate_hz);

}  // namespace risorius::media
