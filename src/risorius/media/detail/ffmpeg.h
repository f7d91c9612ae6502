// SPDX-License-Identifier: MIT
/// \file
/// Owning pointers and error messages for the C objects of the FFmpeg libraries.
#pragma once

#include <memory>
#include <string>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/log.h>
#include <libavutil/opt.h>
#include <libavutil/pixdesc.h>
#include <libswresample/swresample.h>
#include <libswscale/swscale.h>
}

namespace risorius::media::detail {

struct Free {
    void operator()(AVCodecContext* p) const { avcodec_free_context(&p); }
    void operator()(AVFrame* p) const { av_frame_free(&p); }
    void operator()(AVPacket* p) const { av_packet_free(&p); }
    void operator()(SwsContext* p) const { sws_freeContext(p); }
    void operator()(SwrContext* p) const { swr_free(&p); }
};
using CodecPtr = std::unique_ptr<AVCodecContext, Free>;
using FramePtr = std::unique_ptr<AVFrame, Free>;
using PacketPtr = std::unique_ptr<AVPacket, Free>;
using SwrPtr = std::unique_ptr<SwrContext, Free>;
using ScalerPtr = std::unique_ptr<SwsContext, Free>;

inline std::string ffmpeg_text(int code) {
    char text[AV_ERROR_MAX_STRING_SIZE] = {};
    av_strerror(code, text, sizeof text);
    return text;
}

/// The prefix "file:" prevents FFmpeg from reading a colon in a file's name as a protocol.
inline std::string ffmpeg_url(const std::string& path) { return "file:" + path; }

/// Keeps FFmpeg from writing to standard error; errors are reported by exceptions.
inline void silence_ffmpeg() { av_log_set_level(AV_LOG_QUIET); }

}  // namespace risorius::media::detail
