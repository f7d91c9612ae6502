// SPDX-License-Identifier: MIT
#include "risorius/media/detail/encoder.h"

#include <new>
#include <optional>

#include "risorius/core/error.h"
#include "risorius/media/detail/picture_coder.h"
#include "risorius/media/detail/sound_coder.h"

namespace risorius::media::detail {

namespace {

const char* muxer_of(Form form) {
    switch (form) {
        case Form::kMp4:
            return "mp4";
        case Form::kMov:
            return "mov";
        case Form::kWebm:
            return "webm";
        case Form::kMatroska:
        case Form::kFolder:
            break;
    }
    return "matroska";
}

}  // namespace

struct Encoder::Impl {
    std::string name;
    int fps = 0;
    bool webm = false;
    AVFormatContext* format = nullptr;
    AVStream *video = nullptr, *audio = nullptr;
    std::optional<PictureCoder> pictures;
    std::optional<SoundCoder> sound;
    PacketPtr packet;
    std::int64_t frames = 0;

    ~Impl() { close(); }

    void close() {
        if (!format) return;
        if (format->pb) avio_closep(&format->pb);
        avformat_free_context(format);
        format = nullptr;
    }

    void check(int code, const char* what) const {
        if (code < 0) throw RunError(name + ": " + what + ": " + ffmpeg_text(code));
    }

    void set(const char* key, const char* value) const {
        check(av_opt_set(format->priv_data, key, value, 0), key);
    }

    AVStream* add_stream(const AVCodecContext& codec) const {
        AVStream* stream = avformat_new_stream(format, nullptr);
        if (!stream) throw std::bad_alloc();
        stream->time_base = codec.time_base;
        check(avcodec_parameters_from_context(stream->codecpar, &codec), "no stream parameters");
        return stream;
    }

    void open(const std::filesystem::path& file, Form form, const VideoOptions& options,
              bool alpha) {
        silence_ffmpeg();
        fps = options.fps;
        webm = form == Form::kWebm;
        packet.reset(av_packet_alloc());
        if (!packet) throw std::bad_alloc();
        const std::string url = ffmpeg_url(file.string());
        check(avformat_alloc_output_context2(&format, nullptr, muxer_of(form), url.c_str()),
              "no muxer");
        format->flags |= AVFMT_FLAG_BITEXACT;
        // AAC and Opus put priming samples before the first sample, with times below zero. The containers can express that;
        // without this flag, the pictures would be shifted instead.
        format->avoid_negative_ts = AVFMT_AVOID_NEG_TS_DISABLED;
        const bool headers_apart = (format->oformat->flags & AVFMT_GLOBALHEADER) != 0;
        pictures.emplace(name, coding_of(form, options, alpha), options, alpha, headers_apart);
        video = add_stream(pictures->codec());
        video->avg_frame_rate = video->r_frame_rate = pictures->codec().framerate;
        if (form == Form::kWebm && alpha)
            check(av_dict_set(&video->metadata, "alpha_mode", "1", 0), "no memory");
        if (options.sound) {
            sound.emplace(name, form, *options.sound, options.sound_offset_samples, headers_apart);
            audio = add_stream(sound->codec());
        }

        check(avio_open(&format->pb, url.c_str(), AVIO_FLAG_WRITE), "cannot be written");
        if (form == Form::kMp4 || form == Form::kMov) {
            // With the index before the data, a player can start without reading the whole file. Without B-frames the first
            // frame is at time zero, so an edit list is only needed to skip AAC's priming samples.
            set("movflags", "+faststart");
            set("use_editlist", form == Form::kMp4 && sound ? "1" : "0");
        }
        check(avformat_write_header(format, nullptr), "cannot be written");
    }

    void write(AVStream* stream, const AVRational& time_base) {
        av_packet_rescale_ts(packet.get(), time_base, stream->time_base);
        packet->stream_index = stream->index;
        check(av_interleaved_write_frame(format, packet.get()), "cannot be written");
        // Flushed at once, so that a full disk stops the run at the frame that does not fit.
        avio_flush(format->pb);
        check(format->pb->error, "cannot be written");
    }

    void write_packets() {
        while (pictures->receive(packet.get())) write(video, pictures->codec().time_base);
        while (sound && sound->receive(packet.get())) {
            // WebM counts from the first sample that was put in, priming included. CodecDelay says how much of it is priming.
            if (webm) {
                packet->pts += sound->codec().initial_padding;
                packet->dts += sound->codec().initial_padding;
            }
            write(audio, sound->codec().time_base);
        }
    }

    /// The number of sound samples until the end of the frames so far.
    std::int64_t samples() const { return av_rescale(frames, sound->codec().sample_rate, fps); }
};

Encoder::Encoder(const std::filesystem::path& file, std::string name, Form form,
                 const VideoOptions& options, bool alpha)
    : impl_(std::make_unique<Impl>()) {
    impl_->name = std::move(name);
    impl_->open(file, form, options, alpha);
}

Encoder::~Encoder() = default;

void Encoder::append(const Image& frame) {
    impl_->pictures->send(frame);
    ++impl_->frames;
    impl_->write_packets();
    while (impl_->sound && impl_->sound->send_until(impl_->samples())) impl_->write_packets();
}

void Encoder::finish() {
    impl_->pictures->send_end();
    if (impl_->sound) impl_->sound->send_end(impl_->samples());
    impl_->write_packets();
    impl_->check(av_write_trailer(impl_->format), "cannot be written");
    avio_flush(impl_->format->pb);
    impl_->check(impl_->format->pb->error, "cannot be written");
    impl_->check(avio_closep(&impl_->format->pb), "cannot be written");
    impl_->close();
}

}  // namespace risorius::media::detail
