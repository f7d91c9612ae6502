// SPDX-License-Identifier: MIT
/// \file
/// A film that is watched while it is made: every picture leaves at once, with its sound. Nothing that was written is changed later, so
/// it goes to a pipe.
///
///   container   Matroska, of unknown length, one cluster for each picture
///   pictures    H.264 without look-ahead, at a constant frame rate
///   sound       PCM, 16 bits, one channel
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "risorius/core/image.h"

namespace risorius::media {

struct LiveStreamOptions {
    int width_px = 0, height_px = 0;  ///< even
    int fps = 60;
    int sound_rate_hz = 22050;
};

class LiveStream {
  public:
    /// Writes to standard output. `name` is used in messages. Throws Error for a size that is odd, and RunError.
    LiveStream(std::string name, const LiveStreamOptions& options);
    ~LiveStream();
    LiveStream(const LiveStream&) = delete;
    LiveStream& operator=(const LiveStream&) = delete;

    /// The first sample of the sound of a picture, counted from the begin of the film. Picture n is heard until the first sample of the next.
    std::int64_t first_sample(std::int64_t frame) const;
    /// The number of pictures so far.
    std::int64_t frames() const;
    /// Writes one picture with its sound, which must have the samples of this picture. Throws RunError, also when nobody reads
    /// any more.
    void append(const Image& frame, std::span<const float> sound);
    void finish();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace risorius::media
