// SPDX-License-Identifier: MIT
/// \file
/// What the header of a WAV file says, as far as FFmpeg takes it wrongly or does not check it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace risorius::media::detail {

struct WavHeader {
    bool integers = false;           ///< PCM of integers, also as WAVE_FORMAT_EXTENSIBLE
    int container_bits = 0;          ///< bits that a sample takes in the file
    int valid_bits = 0;              ///< bits of them that carry the sound; they are the upper ones
    std::int64_t missing_bytes = 0;  ///< of the sound that the header promises
};

/// Reads the header of a RIFF or RF64 file; empty for another one. Throws Error when the file cannot be read.
std::optional<WavHeader> read_wav_header(const std::filesystem::path& file);

}  // namespace risorius::media::detail
