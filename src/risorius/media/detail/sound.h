// SPDX-License-Identifier: MIT
/// \file
/// Sound of files, read through the FFmpeg libraries: recordings for a video, or the sound of a video for measurements. The delay
/// of decoders (AAC's priming, Opus' pre-skip) is removed as the file states. Recordings are read piece by piece, so that their
/// length costs no memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace risorius::media {

/// Rate, channels and precision of sound.
struct SoundForm {
    int rate_hz = 48000;
    int channels = 1;
    int bits = 16;          ///< per sample in the file: 16, 24, or 32 for floating point
    std::string container;  ///< FFmpeg's name: "wav", "flac", "matroska,webm"
};

/// Sound in memory.
struct Sound : SoundForm {
    double start_s = 0;  ///< time of the first sample; Matroska and WebM round it to a millisecond
    std::vector<float> samples;  ///< interleaved, 1 = full scale; 16 and 24 bits are exact

    std::int64_t length() const {  ///< samples of one channel
        return static_cast<std::int64_t>(samples.size()) / channels;
    }
};

/// A WAV or FLAC file that was read once to its end and found whole.
struct Recording : SoundForm {
    std::filesystem::path file;
    std::int64_t samples_of_channel = 0;
    double gain_db = 0;  ///< change of the level when it is read

    std::int64_t length() const { return samples_of_channel; }  ///< samples of one channel
};

/// Reads the sound of a file of any kind. Throws Error when the file is missing or has no sound.
Sound read_sound(const std::filesystem::path& file);

/// Reads a recording to its end. Throws Error when it is neither WAV nor FLAC, is shorter than its header says, or has a sample
/// that is NaN, infinite, or beyond 24 dB above full scale.
Recording open_recording(const std::filesystem::path& file);

/// Returns a part of a recording with its gain, and silence where the recording does not reach. `offset` is the number of samples
/// from the start of the part to the first sample of the recording, `length` is the length of the part.
Sound part_of(const Recording& recording, std::int64_t offset, std::int64_t length);

/// Does the same piece by piece: calls `take` with interleaved samples and the number of samples of one channel.
void for_each_piece(const Recording& recording, std::int64_t offset, std::int64_t length,
                    const std::function<void(const float*, std::size_t)>& take);

/// Reads a recording at another rate from its start to its end, without a delay.
class ResampledRecording {
  public:
    /// Throws Error, and RunError when there is no conversion between the rates.
    ResampledRecording(const Recording& recording, int rate_hz);
    ~ResampledRecording();
    ResampledRecording(ResampledRecording&&) noexcept;
    ResampledRecording& operator=(ResampledRecording&&) noexcept;

    std::int64_t length() const;  ///< samples of one channel at the new rate, at most

    /// Copies `count` samples of each channel, the first of which is `from`. What lies outside of the recording is silence. `from`
    /// must not be smaller than in the call before. Throws Error when the file has changed.
    void read(std::int64_t from, std::int64_t count, float* to);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace risorius::media
