// SPDX-License-Identifier: MIT
/// \file
/// Encodes sound to the packets of one stream: PCM in MOV and Matroska, AAC in MP4, Opus in WebM.
///
/// The stream begins with the first frame and ends with the last one. Silence is added before and after the recording, and
/// sound outside the video is cut. So the position of a sample does not depend on time stamps, which Matroska rounds to a
/// millisecond.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "risorius/media/detail/ffmpeg.h"
#include "risorius/media/detail/video_form.h"

namespace risorius::media::detail {

class SoundCoder {
  public:
    /// `offset_samples`: number of samples from the first frame to the first sample, at the recording's own rate.
    SoundCoder(std::string name, Form form, const Recording& recording, std::int64_t offset_samples,
               bool headers_apart);

    /// Sends the sound up to a given sample to the encoder. Returns true as long as packets must be received before it takes
    /// more.
    bool send_until(std::int64_t sample);
    /// Does the same with the last block, which may have any length.
    void send_end(std::int64_t sample);
    bool receive(AVPacket* packet);
    const AVCodecContext& codec() const { return *codec_; }

  private:
    void send(int length);
    void check(int code, const char* what) const;

    std::string name_;
    std::optional<ResampledRecording> sound_;
    std::vector<float> heard_;  ///< samples of the block that is sent
    int channels_ = 1;
    std::int64_t first_ = 0;  ///< position of the sound's first sample in the stream
    CodecPtr codec_;
    FramePtr piece_;
    std::int64_t next_ = 0;
};

}  // namespace risorius::media::detail
