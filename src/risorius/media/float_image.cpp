// SPDX-License-Identifier: MIT
#include "risorius/media/float_image.h"

#include <new>
#include <string>

#include "risorius/core/error.h"
#include "risorius/core/output_set.h"
#include "risorius/media/detail/ffmpeg.h"
#include "risorius/media/detail/temporary_file.h"

namespace risorius::media {

using namespace detail;

namespace {

// Index of the plane (G, B, R) for channels 0, 1, 2 = R, G, B.
constexpr int kPlaneOf[] = {2, 0, 1};

template <typename Row>
void each_float_row(const AVFrame& frame, int channels, Row row) {
    for (int y = 0; y < frame.height; ++y)
        for (int c = 0; c < channels; ++c) {
            const int plane = channels == 1 ? 0 : kPlaneOf[c];
            row(y, c,
                reinterpret_cast<float*>(frame.data[plane] +
                                         std::ptrdiff_t{y} * frame.linesize[plane]));
        }
}

struct ExrCodec {
    CodecPtr codec;
    FramePtr frame{av_frame_alloc()};
    PacketPtr packet{av_packet_alloc()};

    ExrCodec(const AVCodec* which, const std::string& name) {
        if (!which) throw RunError(name + ": the installed libavcodec has no OpenEXR");
        codec.reset(avcodec_alloc_context3(which));
        if (!codec || !frame || !packet) throw std::bad_alloc();
        codec->thread_count = 1;
    }
};

}  // namespace

void write_exr(const FloatImage& image, const std::filesystem::path& file) {
    silence_ffmpeg();
    const std::string name = file.string();
    const AVCodec* encoder = avcodec_find_encoder(AV_CODEC_ID_EXR);
    ExrCodec exr(encoder, name);
    const auto check = [&](int code) {
        if (code < 0) throw RunError(name + ": cannot be encoded as OpenEXR: " + ffmpeg_text(code));
    };
    exr.codec->width = exr.frame->width = image.width_px;
    exr.codec->height = exr.frame->height = image.height_px;
    exr.codec->pix_fmt = image.channels == 1 ? AV_PIX_FMT_GRAYF32 : AV_PIX_FMT_GBRPF32;
    exr.frame->format = exr.codec->pix_fmt;
    exr.codec->time_base = {1, 1};
    exr.codec->flags |= AV_CODEC_FLAG_BITEXACT;
    check(av_opt_set(exr.codec->priv_data, "compression", "zip16", 0));
    check(av_opt_set(exr.codec->priv_data, "format", "float", 0));
    check(avcodec_open2(exr.codec.get(), encoder, nullptr));
    check(av_frame_get_buffer(exr.frame.get(), 0));
    const float* samples = image.samples.data();
    each_float_row(*exr.frame, image.channels, [&](int y, int c, float* to) {
        const float* from = samples + std::ptrdiff_t{y} * image.width_px * image.channels + c;
        for (int x = 0; x < image.width_px; ++x) to[x] = from[std::ptrdiff_t{x} * image.channels];
    });
    exr.frame->pts = 0;
    check(avcodec_send_frame(exr.codec.get(), exr.frame.get()));
    check(avcodec_send_frame(exr.codec.get(), nullptr));
    check(avcodec_receive_packet(exr.codec.get(), exr.packet.get()));
    write_file(file, {reinterpret_cast<const char*>(exr.packet->data),
                      static_cast<std::size_t>(exr.packet->size)});
}

FloatImage read_exr(const std::filesystem::path& file) {
    silence_ffmpeg();
    const std::string name = file.string();
    std::vector<unsigned char> bytes = read_whole(file, "an OpenEXR picture");
    const int size = static_cast<int>(bytes.size());
    bytes.resize(bytes.size() + AV_INPUT_BUFFER_PADDING_SIZE, 0);
    const AVCodec* decoder = avcodec_find_decoder(AV_CODEC_ID_EXR);
    ExrCodec exr(decoder, name);
    exr.packet->data = bytes.data();
    exr.packet->size = size;
    if (avcodec_open2(exr.codec.get(), decoder, nullptr) < 0 ||
        avcodec_send_packet(exr.codec.get(), exr.packet.get()) < 0 ||
        avcodec_receive_frame(exr.codec.get(), exr.frame.get()) < 0)
        throw Error(name, "an OpenEXR picture", "another kind of file, or one cut short");
    const bool grey = exr.frame->format == AV_PIX_FMT_GRAYF32;
    if (!grey && exr.frame->format != AV_PIX_FMT_GBRPF32)
        throw Error(name, "a picture of Y or of R, G and B in floating point", "another kind");
    FloatImage image{exr.frame->width, exr.frame->height, grey ? 1 : 3, {}};
    image.samples.resize(static_cast<std::size_t>(image.width_px) *
                         static_cast<std::size_t>(image.height_px) *
                         static_cast<std::size_t>(image.channels));
    float* samples = image.samples.data();
    each_float_row(*exr.frame, image.channels, [&](int y, int c, const float* from) {
        float* to = samples + std::ptrdiff_t{y} * image.width_px * image.channels + c;
        for (int x = 0; x < image.width_px; ++x) to[std::ptrdiff_t{x} * image.channels] = from[x];
    });
    return image;
}

}  // namespace risorius::media
