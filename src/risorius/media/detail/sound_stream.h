// SPDX-License-Identifier: MIT
/// \file
/// Decodes the sound of a file from its start to its end, piece by piece.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "risorius/media/detail/ffmpeg.h"
#include "risorius/media/detail/sound.h"
#include "risorius/media/detail/wav_header.h"

namespace risorius::media::detail {

class SoundStream {
  public:
    /// Throws Error when the file cannot be read or has no sound.
    explicit SoundStream(const std::filesystem::path& file);
    ~SoundStream();
    SoundStream(const SoundStream&) = delete;
    SoundStream& operator=(const SoundStream&) = delete;

    const SoundForm& form() const { return form_; }
    /// Time of the first sample, s, as soon as next() has been called
    double start_s() const { return start_s_; }

    /// Reads the next samples, interleaved. Returns false at the end. Throws Error for a read error, for damaged data, and for a
    /// sample that is not finite or far beyond full scale.
    bool next(std::vector<float>& piece);

    /// Samples of each channel by the header, which may lie; 0: unknown
    std::int64_t promised() const { return promised_; }
    /// Throws Error when `length`, the samples of each channel that were read to the end, is less than the header promises.
    void check_whole(std::int64_t length) const;

  private:
    void open_decoder();
    bool receive();
    void take(std::vector<float>& piece);
    int check(int code) const;

    std::string name_;
    std::optional<WavHeader> wav_;
    std::int64_t promised_ = 0;  ///< samples of each channel by the header; 0: unknown
    SoundForm form_;
    double start_s_ = 0;
    std::int64_t taken_ = 0;  ///< samples of each channel
    bool draining_ = false;
    AVFormatContext* format_ = nullptr;
    AVStream* stream_ = nullptr;
    CodecPtr codec_;
    FramePtr piece_;
    PacketPtr packet_;
};

}  // namespace risorius::media::detail
