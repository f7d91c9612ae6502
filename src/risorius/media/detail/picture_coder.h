// SPDX-License-Identifier: MIT
/// \file
/// Encodes pictures to the packets of one video stream. The settings and their reasons:
///
///   no B-frames         decoding order is display order, so players that step frame by frame cannot be off by one
///   closed groups       of a quarter of a second by default, without scene detection: reaching any frame takes few others
///   four threads        x264's bytes depend on the number of threads, so the number does not depend on the machine
///   BT.709, limited     the sRGB-encoded values are stored unchanged as R'G'B', as video players assume
#pragma once

#include <string>

#include "risorius/core/image.h"
#include "risorius/media/detail/ffmpeg.h"
#include "risorius/media/detail/video_form.h"

namespace risorius::media::detail {

class PictureCoder {
  public:
    /// `name` is used in messages. `headers_apart`: the container stores the codec's headers separately.
    PictureCoder(std::string name, Coding coding, const VideoOptions& options, bool alpha,
                 bool headers_apart);

    void send(const Image& frame);
    void send_end();
    /// Returns false when the encoder needs more pictures or has returned all packets.
    bool receive(AVPacket* packet);
    const AVCodecContext& codec() const { return *codec_; }

  private:
    void open_h264(const VideoOptions& options);
    void open_vp9(const VideoOptions& options, Coding coding, bool alpha);
    void open_conversion(const VideoOptions& options, bool alpha);
    void describe_rgb();
    void describe_bt709();
    void convert(const Image& frame);
    void set(const char* key, const std::string& value) const;
    void check(int code, const char* what) const;

    std::string name_;
    CodecPtr codec_;
    FramePtr picture_;
    ScalerPtr scaler_;
    std::int64_t next_ = 0;
};

}  // namespace risorius::media::detail
