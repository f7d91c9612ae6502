// SPDX-License-Identifier: MIT
#include "risorius/media/jpeg_file.h"

#include <algorithm>
#include <cmath>

#include "risorius/core/error.h"
#include "risorius/media/detail/ffmpeg.h"

namespace risorius::media {

namespace {

using namespace detail;

/// Y, Cb and Cr with full range, as JFIF has them (ITU-T T.871, BT.601). Colour is that of two by two pixels: without this, libavcodec
/// writes a kind of JPEG that some readers do not know (Godot 3).
void put_ycc(const Image& image, AVFrame& frame) {
    const auto byte = [](double value) {
        return static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
    };
    const auto put = [&](int plane, int x, int y, double value) {
        frame.data[plane][std::ptrdiff_t{y} * frame.linesize[plane] + x] = byte(value);
    };
    const auto luma = [](double r, double g, double b) {
        return 0.299 * r + 0.587 * g + 0.114 * b;
    };
    for (int y = 0; y < image.height_px; y += 2)
        for (int x = 0; x < image.width_px; x += 2) {
            double sum[3] = {0, 0, 0}, count = 0;
            for (int v = y; v < std::min(y + 2, image.height_px); ++v)
                for (int u = x; u < std::min(x + 2, image.width_px); ++u) {
                    const std::uint8_t* const rgb = image.pixel(u, v);
                    put(0, u, v, luma(rgb[0], rgb[1], rgb[2]));
                    for (int c = 0; c < 3; ++c) sum[c] += rgb[c];
                    ++count;
                }
            const double r = sum[0] / count, g = sum[1] / count, b = sum[2] / count;
            put(1, x / 2, y / 2, 128 + (b - luma(r, g, b)) / 1.772);
            put(2, x / 2, y / 2, 128 + (r - luma(r, g, b)) / 1.402);
        }
}

}  // namespace

std::string jpeg_bytes(const Image& image, const std::string& name, int quantizer) {
    if (image.width_px < 1 || image.height_px < 1)
        throw Error(name, "a picture of at least 1 x 1 pixels",
                    std::to_string(image.width_px) + " x " + std::to_string(image.height_px));
    silence_ffmpeg();
    const auto check = [&](int code) {
        if (code < 0) throw RunError(name + ": cannot be encoded as JPEG: " + ffmpeg_text(code));
    };
    const AVCodec* encoder = avcodec_find_encoder(AV_CODEC_ID_MJPEG);
    if (!encoder) throw RunError(name + ": the installed libavcodec has no JPEG");
    const CodecPtr codec(avcodec_alloc_context3(encoder));
    const FramePtr frame(av_frame_alloc());
    const PacketPtr packet(av_packet_alloc());
    if (!codec || !frame || !packet) throw std::bad_alloc();
    codec->thread_count = 1;
    codec->width = frame->width = image.width_px;
    codec->height = frame->height = image.height_px;
    codec->pix_fmt = AV_PIX_FMT_YUVJ420P;
    codec->color_range = frame->color_range = AVCOL_RANGE_JPEG;
    frame->format = codec->pix_fmt;
    codec->time_base = {1, 1};
    codec->flags |= AV_CODEC_FLAG_BITEXACT | AV_CODEC_FLAG_QSCALE;
    codec->qmin = codec->qmax = quantizer;
    codec->global_quality = frame->quality = FF_QP2LAMBDA * quantizer;
    check(avcodec_open2(codec.get(), encoder, nullptr));
    check(av_frame_get_buffer(frame.get(), 0));
    put_ycc(image, *frame);
    frame->pts = 0;
    check(avcodec_send_frame(codec.get(), frame.get()));
    check(avcodec_send_frame(codec.get(), nullptr));
    check(avcodec_receive_packet(codec.get(), packet.get()));
    return {reinterpret_cast<const char*>(packet->data), static_cast<std::size_t>(packet->size)};
}

}  // namespace risorius::media
