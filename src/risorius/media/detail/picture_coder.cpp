// SPDX-License-Identifier: MIT
#include "risorius/media/detail/picture_coder.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "risorius/core/error.h"
#include "risorius/media/detail/rgb_pixels.h"

namespace risorius::media::detail {

namespace {

constexpr int kThreads = 4;
constexpr int kSlices = 4;
constexpr int kUsualH264Crf = 18;  // hard to distinguish from the original
constexpr int kMaxH264Crf = 51, kLaterCrf = 24;
constexpr double kUsualIpRatio = 1.4;  // of quantizers; 6 steps of crf are a factor of 2
constexpr int kUsualVp9Crf = 24;       // about the same quality
// Motion search to fractions of a pixel: half the steps of the preset "faster".
constexpr const char* kUsualRefinement = ":subme=2";

/// Instruction sets that x264 may use: all but AVX-512. With AVX-512, the macroblock tree of build 164 sometimes makes other
/// bytes from the same pictures, depending on memory addresses. This was seen at 64 x 48 and 320 x 240, but never without
/// AVX-512 or without the tree.
std::string instructions() {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f") > 0) return ":asm=SSE2Fast,LZCNT,FMA3,BMI2,AVX2";
#endif
    return "";
}

const char* encoder_of(Coding coding) {
    switch (coding) {
        case Coding::kH264:
            return "libx264";
        case Coding::kH264Rgb:
            return "libx264rgb";
        case Coding::kProRes:
            return "prores_ks";
        case Coding::kPng:
            return "png";
        case Coding::kFfv1:
            return "ffv1";
        case Coding::kVp9:
        case Coding::kVp9Rgb:
            break;
    }
    return "libvpx-vp9";
}

}  // namespace

void PictureCoder::check(int code, const char* what) const {
    if (code < 0) throw RunError(name_ + ": " + what + ": " + ffmpeg_text(code));
}

void PictureCoder::set(const char* key, const std::string& value) const {
    check(av_opt_set(codec_->priv_data, key, value.c_str(), 0), key);
}

PictureCoder::PictureCoder(std::string name, Coding coding, const VideoOptions& options, bool alpha,
                           bool headers_apart)
    : name_(std::move(name)) {
    const AVCodec* encoder = avcodec_find_encoder_by_name(encoder_of(coding));
    if (!encoder)
        throw RunError(name_ + ": the installed libavcodec has no " + encoder_of(coding) +
                       " encoder");
    codec_.reset(avcodec_alloc_context3(encoder));
    picture_.reset(av_frame_alloc());
    if (!codec_ || !picture_) throw std::bad_alloc();

    codec_->width = options.width_px;
    codec_->height = options.height_px;
    codec_->time_base = {1, options.fps};
    codec_->framerate = {options.fps, 1};
    codec_->sample_aspect_ratio = {1, 1};
    codec_->color_primaries = AVCOL_PRI_BT709;
    codec_->thread_count = kThreads;
    codec_->flags |= AV_CODEC_FLAG_BITEXACT;
    if (headers_apart) codec_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    codec_->gop_size = options.keyframe_interval.value_or(std::max(1, options.fps / 4));
    switch (coding) {
        case Coding::kH264:
            codec_->pix_fmt =
                halves_colour(coding, options) ? AV_PIX_FMT_YUV420P : AV_PIX_FMT_YUV444P;
            describe_bt709();
            open_h264(options);
            break;
        case Coding::kH264Rgb:
            codec_->pix_fmt = AV_PIX_FMT_RGB24;
            describe_rgb();
            open_h264(options);
            break;
        case Coding::kProRes:
            codec_->pix_fmt = AV_PIX_FMT_YUVA444P10;
            describe_bt709();
            set("profile", "4444");
            set("alpha_bits", "16");
            set("vendor", "apl0");
            break;
        case Coding::kPng:
            codec_->pix_fmt = AV_PIX_FMT_RGBA;
            describe_rgb();
            break;
        case Coding::kFfv1:
            if (options.bits.value_or(8) == 16)
                codec_->pix_fmt = alpha ? AV_PIX_FMT_GBRAP16 : AV_PIX_FMT_GBRP16;
            else
                codec_->pix_fmt = alpha ? AV_PIX_FMT_BGRA : AV_PIX_FMT_0RGB32;
            describe_rgb();
            codec_->gop_size = 1;  // every frame is coded by itself
            codec_->level = 3;
            codec_->slices = kSlices;
            codec_->thread_type = FF_THREAD_SLICE;
            set("slicecrc", "1");
            break;
        case Coding::kVp9:
        case Coding::kVp9Rgb:
            open_vp9(options, coding, alpha);
            break;
    }
    check(avcodec_open2(codec_.get(), encoder, nullptr), "the encoder does not start");
    if (!(av_pix_fmt_desc_get(codec_->pix_fmt)->flags & AV_PIX_FMT_FLAG_RGB))
        open_conversion(options, alpha);

    picture_->format = codec_->pix_fmt;
    picture_->width = codec_->width;
    picture_->height = codec_->height;
    picture_->color_range = codec_->color_range;
    picture_->colorspace = codec_->colorspace;
    picture_->color_primaries = codec_->color_primaries;
    picture_->color_trc = codec_->color_trc;
    picture_->chroma_location = codec_->chroma_sample_location;
    check(av_frame_get_buffer(picture_.get(), 0), "no memory for a frame");
}

void PictureCoder::describe_rgb() {
    codec_->colorspace = AVCOL_SPC_RGB;
    codec_->color_trc = AVCOL_TRC_IEC61966_2_1;
    codec_->color_range = AVCOL_RANGE_JPEG;
}

void PictureCoder::describe_bt709() {
    codec_->colorspace = AVCOL_SPC_BT709;
    codec_->color_trc = AVCOL_TRC_BT709;
    codec_->color_range = AVCOL_RANGE_MPEG;
    codec_->chroma_sample_location = AVCHROMA_LOC_LEFT;
}

void PictureCoder::open_h264(const VideoOptions& options) {
    codec_->max_b_frames = 0;
    codec_->flags |= AV_CODEC_FLAG_CLOSED_GOP;
    set("preset", options.preset.value_or("faster"));
    if (options.live) set("tune", "zerolatency");
    const std::string refinement = options.preset || options.lossless ? "" : kUsualRefinement;
    const int crf = options.crf.value_or(kUsualH264Crf);
    const int later = options.still ? std::min(kLaterCrf, kMaxH264Crf - crf) : 0;
    if (options.lossless)
        set("qp", "0");
    else
        // The quantizers of a still are fixed: later frames are so much coarser than the first that they correct nothing of it.
        set(options.still ? "qp" : "crf", std::to_string(crf + later));
    const std::string still =
        options.still && !options.lossless
            ? ":weightp=0:ipratio=" + std::to_string(kUsualIpRatio * std::pow(2, later / 6.0))
            : "";
    set("x264-params", "scenecut=0" + refinement + still + instructions());
}

void PictureCoder::open_vp9(const VideoOptions& options, Coding coding, bool alpha) {
    if (coding == Coding::kVp9Rgb) {
        codec_->pix_fmt = AV_PIX_FMT_GBRP;
        describe_rgb();
        set("lossless", "1");
    } else {
        codec_->pix_fmt = alpha                            ? AV_PIX_FMT_YUVA420P
                          : halves_colour(coding, options) ? AV_PIX_FMT_YUV420P
                                                           : AV_PIX_FMT_YUV444P;
        describe_bt709();
        set("crf", std::to_string(options.crf.value_or(kUsualVp9Crf)));
    }
    codec_->bit_rate = 0;  // quality alone determines the rate
    codec_->keyint_min = codec_->gop_size;
    // No frame is decoded without being shown, and none is held back: every packet is one picture.
    set("auto-alt-ref", "0");
    set("lag-in-frames", "0");
    set("deadline", "good");
    set("cpu-used", "4");
    set("row-mt", "0");
}

void PictureCoder::open_conversion(const VideoOptions& options, bool alpha) {
    scaler_.reset(sws_alloc_context());
    if (!scaler_) throw std::bad_alloc();
    SwsContext* sws = scaler_.get();
    for (const char* side : {"src", "dst"}) {
        check(av_opt_set_int(sws, (std::string(side) + "w").c_str(), options.width_px, 0), "width");
        check(av_opt_set_int(sws, (std::string(side) + "h").c_str(), options.height_px, 0),
              "height");
    }
    av_opt_set_int(sws, "src_format", alpha ? AV_PIX_FMT_RGBA : AV_PIX_FMT_RGB0, 0);
    av_opt_set_int(sws, "dst_format", codec_->pix_fmt, 0);
    // Chroma samples lie beside the left luma column and between the rows, as H.264 assumes.
    if (codec_->pix_fmt == AV_PIX_FMT_YUV420P || codec_->pix_fmt == AV_PIX_FMT_YUVA420P) {
        av_opt_set_int(sws, "dst_h_chr_pos", 0, 0);
        av_opt_set_int(sws, "dst_v_chr_pos", 128, 0);
    }
    av_opt_set_int(sws, "sws_flags",
                   SWS_BICUBIC | SWS_FULL_CHR_H_INP | SWS_ACCURATE_RND | SWS_BITEXACT, 0);
    const int* bt709 = sws_getCoefficients(SWS_CS_ITU709);
    constexpr int kOne = 1 << 16;
    sws_setColorspaceDetails(sws, bt709, /*srcRange=*/1, bt709, /*dstRange=*/0, /*brightness=*/0,
                             /*contrast=*/kOne, /*saturation=*/kOne);
    check(sws_init_context(sws, nullptr, nullptr), "no colour conversion");
}

void PictureCoder::convert(const Image& frame) {
    check(av_frame_make_writable(picture_.get()), "no memory for a frame");
    if (!scaler_) {
        put_rgb_pixels(frame, *picture_);
        return;
    }
    const std::uint8_t* rows[4] = {frame.rgba.data(), nullptr, nullptr, nullptr};
    const int strides[4] = {frame.width_px * 4, 0, 0, 0};
    check(sws_scale(scaler_.get(), rows, strides, 0, frame.height_px, picture_->data,
                    picture_->linesize),
          "no colour conversion");
}

void PictureCoder::send(const Image& frame) {
    convert(frame);
    picture_->pts = next_++;
    check(avcodec_send_frame(codec_.get(), picture_.get()), "the encoder gave up");
}

void PictureCoder::send_end() {
    check(avcodec_send_frame(codec_.get(), nullptr), "the encoder gave up");
}

bool PictureCoder::receive(AVPacket* packet) {
    const int code = avcodec_receive_packet(codec_.get(), packet);
    if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return false;
    check(code, "the encoder gave up");
    packet->duration = 1;
    return true;
}

}  // namespace risorius::media::detail
