// SPDX-License-Identifier: MIT
#include "risorius/media/live_stream.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>

#include "risorius/core/error.h"
#include "risorius/media/detail/picture_coder.h"

namespace risorius::media {

using detail::Coding;
using detail::ffmpeg_text;
using detail::PacketPtr;
using detail::PictureCoder;
using detail::silence_ffmpeg;

struct LiveStream::Impl {
    std::string name;
    LiveStreamOptions options;
    AVFormatContext* format = nullptr;
    AVStream *video = nullptr, *audio = nullptr;
    std::optional<PictureCoder> pictures;
    PacketPtr packet;
    std::int64_t frames = 0;

    ~Impl() {
        if (!format) return;
        if (format->pb) avio_closep(&format->pb);
        avformat_free_context(format);
    }

    void check(int code, const char* what = "cannot be written") const {
        if (code < 0) throw RunError(name + ": " + what + ": " + ffmpeg_text(code));
    }

    AVStream* add_stream(AVRational time_base) const {
        AVStream* stream = avformat_new_stream(format, nullptr);
        if (!stream) throw std::bad_alloc();
        stream->time_base = time_base;
        return stream;
    }

    void open() {
        silence_ffmpeg();
        packet.reset(av_packet_alloc());
        if (!packet) throw std::bad_alloc();
        check(avformat_alloc_output_context2(&format, nullptr, "matroska", "pipe:1"), "no muxer");
        format->flags |= AVFMT_FLAG_BITEXACT;
        VideoOptions coded;
        coded.width_px = options.width_px;
        coded.height_px = options.height_px;
        coded.fps = options.fps;
        coded.preset = "ultrafast";
        coded.live = true;
        pictures.emplace(name, Coding::kH264, coded, /*alpha=*/false, /*headers_apart=*/true);
        video = add_stream(pictures->codec().time_base);
        check(avcodec_parameters_from_context(video->codecpar, &pictures->codec()), "no stream");
        video->avg_frame_rate = video->r_frame_rate = pictures->codec().framerate;
        audio = add_stream({1, options.sound_rate_hz});
        audio->codecpar->codec_type = AVMEDIA_TYPE_AUDIO;
        audio->codecpar->codec_id = AV_CODEC_ID_PCM_S16LE;
        audio->codecpar->format = AV_SAMPLE_FMT_S16;
        audio->codecpar->sample_rate = options.sound_rate_hz;
        audio->codecpar->bits_per_coded_sample = 16;
        audio->codecpar->block_align = 2;
        av_channel_layout_default(&audio->codecpar->ch_layout, 1);
        check(avio_open(&format->pb, "pipe:1", AVIO_FLAG_WRITE));
        check(av_opt_set(format->priv_data, "live", "1", 0), "live");
        check(avformat_write_header(format, nullptr));
        flush();
    }

    void flush() const {
        // Ends the cluster, so that the picture is not kept until the next one.
        check(av_write_frame(format, nullptr));
        avio_flush(format->pb);
        check(format->pb->error);
    }

    void write(AVStream* stream, AVRational time_base) {
        av_packet_rescale_ts(packet.get(), time_base, stream->time_base);
        packet->stream_index = stream->index;
        const int code = av_write_frame(format, packet.get());
        av_packet_unref(packet.get());
        check(code);
    }

    void write_sound(std::int64_t first, std::span<const float> sound) {
        if (sound.empty()) return;
        check(av_new_packet(packet.get(), static_cast<int>(2 * sound.size())), "no memory");
        std::uint8_t* to = packet->data;
        for (const float value : sound) {
            const auto sample = static_cast<std::uint16_t>(static_cast<std::int16_t>(
                std::clamp(std::lround(32768.0 * static_cast<double>(value)), -32768L, 32767L)));
            *to++ = static_cast<std::uint8_t>(sample & 255U);
            *to++ = static_cast<std::uint8_t>(sample >> 8U);
        }
        packet->pts = packet->dts = first;
        packet->duration = static_cast<std::int64_t>(sound.size());
        packet->flags |= AV_PKT_FLAG_KEY;
        write(audio, {1, options.sound_rate_hz});
    }

    void write_pictures() {
        while (pictures->receive(packet.get())) write(video, pictures->codec().time_base);
    }
};

LiveStream::LiveStream(std::string name, const LiveStreamOptions& options)
    : impl_(std::make_unique<Impl>()) {
    if (options.width_px % 2 != 0 || options.height_px % 2 != 0)
        throw Error(option_name("size"), "an even width and height",
                    std::to_string(options.width_px) + "x" + std::to_string(options.height_px));
    impl_->name = std::move(name);
    impl_->options = options;
    impl_->open();
}

LiveStream::~LiveStream() = default;

std::int64_t LiveStream::first_sample(std::int64_t frame) const {
    return frame * impl_->options.sound_rate_hz / impl_->options.fps;
}

std::int64_t LiveStream::frames() const { return impl_->frames; }

void LiveStream::append(const Image& frame, std::span<const float> sound) {
    impl_->write_sound(first_sample(impl_->frames), sound);
    impl_->pictures->send(frame);
    ++impl_->frames;
    impl_->write_pictures();
    impl_->flush();
}

void LiveStream::finish() {
    impl_->pictures->send_end();
    impl_->write_pictures();
    impl_->check(av_write_trailer(impl_->format));
    avio_flush(impl_->format->pb);
    impl_->check(impl_->format->pb->error);
}

}  // namespace risorius::media
