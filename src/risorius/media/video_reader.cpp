// SPDX-License-Identifier: MIT
// Decodes forward from the nearest key frame. Frames are identified by their time stamps.
#include "risorius/media/video_reader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <string>
#include <vector>

#include "risorius/core/error.h"
#include "risorius/core/read_file.h"
#include "risorius/core/stand_in.h"
#include "risorius/media/detail/ffmpeg.h"
#include "risorius/media/detail/rgb_pixels.h"

namespace risorius::media {

using namespace detail;

namespace {

constexpr FileKind kVideoFile{"a video file", std::numeric_limits<std::uint64_t>::max()};

}  // namespace

struct VideoReader::Impl {
    std::string name;
    AVFormatContext* format = nullptr;
    AVStream* stream = nullptr;
    CodecPtr codec;
    FramePtr picture;
    PacketPtr packet;
    std::vector<std::int64_t> stamps;  ///< of every frame in display order, in units of the stream
    int next = 0;                      ///< frame that the decoder returns next
    bool draining = false;

    ~Impl() {
        if (format) avformat_close_input(&format);
    }

    void open(const std::filesystem::path& file);
    void read_index();
    bool decode();
    void seek(int frame);
    Image convert() const;
};

void VideoReader::Impl::open(const std::filesystem::path& file) {
    silence_ffmpeg();
    name = file.string();
    check_file(file, kVideoFile);
    if (avformat_open_input(&format, ffmpeg_url(file_to_read(file).string()).c_str(), nullptr,
                            nullptr) < 0 ||
        avformat_find_stream_info(format, nullptr) < 0)
        throw Error(name, "a video file", "another kind of file, or one cut short");
    const AVCodec* decoder = nullptr;
    const int index = av_find_best_stream(format, AVMEDIA_TYPE_VIDEO, -1, -1, &decoder, 0);
    if (index < 0 || !decoder) throw Error(name, "a video stream", "none that can be decoded");
    stream = format->streams[index];
    // FFmpeg's own decoder of VP9 ignores transparency.
    if (decoder->id == AV_CODEC_ID_VP9 && av_dict_get(stream->metadata, "alpha_mode", nullptr, 0))
        if (const AVCodec* whole = avcodec_find_decoder_by_name("libvpx-vp9")) decoder = whole;

    codec.reset(avcodec_alloc_context3(decoder));
    picture.reset(av_frame_alloc());
    packet.reset(av_packet_alloc());
    if (!codec || !picture || !packet) throw std::bad_alloc();
    codec->thread_count = 1;
    codec->err_recognition = AV_EF_CRCCHECK | AV_EF_EXPLODE;
    if (avcodec_parameters_to_context(codec.get(), stream->codecpar) < 0 ||
        avcodec_open2(codec.get(), decoder, nullptr) < 0)
        throw Error(name, "a video that can be decoded", "a decoder that does not start");
    read_index();
}

void VideoReader::Impl::read_index() {
    bool damaged = false;
    int code = 0;
    while ((code = av_read_frame(format, packet.get())) >= 0) {
        if (packet->stream_index == stream->index) {
            damaged = damaged || (packet->flags & AV_PKT_FLAG_CORRUPT);
            stamps.push_back(packet->pts != AV_NOPTS_VALUE ? packet->pts : packet->dts);
        }
        av_packet_unref(packet.get());
    }
    // An error of the disk is not the end of the file.
    if (format->pb && format->pb->error < 0) code = format->pb->error;
    if (code == AVERROR(EIO)) throw Error(name, "a video file that can be read", ffmpeg_text(code));
    std::sort(stamps.begin(), stamps.end());

    // The header is written last and tells the expected size: MP4 the number of frames, Matroska the duration.
    std::int64_t promised = stream->nb_frames;
    if (promised == 0 && format->duration > 0)
        promised = std::llround(static_cast<double>(format->duration) / AV_TIME_BASE *
                                av_q2d(stream->avg_frame_rate));
    const auto found = static_cast<std::int64_t>(stamps.size());
    if (damaged || found < promised)
        throw Error(name, std::to_string(promised) + " frames, as its header says",
                    damaged ? "a frame cut short" : "only " + std::to_string(found));
    if (stamps.empty()) throw Error(name, "a video with frames", "none");
    seek(0);
}

void VideoReader::Impl::seek(int frame) {
    if (av_seek_frame(format, stream->index, stamps[static_cast<std::size_t>(frame)],
                      AVSEEK_FLAG_BACKWARD) < 0)
        throw Error(name, "a video that can be searched", "one that cannot");
    avcodec_flush_buffers(codec.get());
    draining = false;
}

/// Decodes the next picture of the stream. Returns false at the end.
bool VideoReader::Impl::decode() {
    for (;;) {
        const int got = avcodec_receive_frame(codec.get(), picture.get());
        if (got >= 0) return true;
        if (got == AVERROR_EOF) return false;
        if (got != AVERROR(EAGAIN))
            throw Error(name, "frames that can be decoded", ffmpeg_text(got));
        if (draining) return false;
        int sent = 0;
        if (av_read_frame(format, packet.get()) < 0) {
            draining = true;
            sent = avcodec_send_packet(codec.get(), nullptr);
        } else {
            if (packet->stream_index == stream->index)
                sent = avcodec_send_packet(codec.get(), packet.get());
            av_packet_unref(packet.get());
        }
        if (sent < 0) throw Error(name, "frames that can be decoded", ffmpeg_text(sent));
    }
}

Image VideoReader::Impl::convert() const {
    const auto format_in = static_cast<AVPixelFormat>(picture->format);
    if (is_rgb_of_whole_bytes(format_in)) return rgb_pixels_of(*picture);
    Image image(picture->width, picture->height);
    const int flags =
        SWS_BICUBIC | SWS_FULL_CHR_H_INT | SWS_FULL_CHR_H_INP | SWS_ACCURATE_RND | SWS_BITEXACT;
    const ScalerPtr scaler(sws_getContext(picture->width, picture->height, format_in,
                                          picture->width, picture->height, AV_PIX_FMT_RGBA, flags,
                                          nullptr, nullptr, nullptr));
    if (!scaler) throw Error(name, "a pixel format that can be converted", "another one");
    // When the file does not tell: by convention, high-definition heights use BT.709 and lower ones BT.601.
    int space = picture->colorspace;
    if (space == AVCOL_SPC_UNSPECIFIED)
        space = picture->height >= 720 ? AVCOL_SPC_BT709 : AVCOL_SPC_SMPTE170M;
    const int* matrix = sws_getCoefficients(space);
    constexpr int kOne = 1 << 16;
    sws_setColorspaceDetails(scaler.get(), matrix, picture->color_range == AVCOL_RANGE_JPEG, matrix,
                             /*dstRange=*/1, /*brightness=*/0, /*contrast=*/kOne,
                             /*saturation=*/kOne);
    std::uint8_t* rows[4] = {image.rgba.data(), nullptr, nullptr, nullptr};
    const int strides[4] = {image.width_px * 4, 0, 0, 0};
    sws_scale(scaler.get(), picture->data, picture->linesize, 0, picture->height, rows, strides);
    return image;
}

VideoReader::VideoReader(const std::filesystem::path& file) : impl_(std::make_unique<Impl>()) {
    impl_->open(file);
}

VideoReader::~VideoReader() = default;

int VideoReader::frames() const { return static_cast<int>(impl_->stamps.size()); }
int VideoReader::width_px() const { return impl_->codec->width; }
int VideoReader::height_px() const { return impl_->codec->height; }
double VideoReader::fps() const { return av_q2d(impl_->stream->avg_frame_rate); }

double VideoReader::time_s(int frame) const {
    return static_cast<double>(impl_->stamps.at(static_cast<std::size_t>(frame))) *
           av_q2d(impl_->stream->time_base);
}

Image VideoReader::frame(int frame) {
    if (frame < 0 || frame >= frames())
        throw Error(impl_->name, "a frame in [0, " + std::to_string(frames() - 1) + "]",
                    std::to_string(frame));
    if (frame != impl_->next) impl_->seek(frame);
    const std::int64_t wanted = impl_->stamps[static_cast<std::size_t>(frame)];
    while (impl_->decode()) {
        if (impl_->picture->best_effort_timestamp < wanted) continue;
        impl_->next = frame + 1;
        return impl_->convert();
    }
    impl_->next = -1;
    throw Error(impl_->name, "frame " + std::to_string(frame), "the end of the video");
}

}  // namespace risorius::media
