// SPDX-License-Identifier: MIT
#include "risorius/media/detail/sound_coder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <new>

#include "risorius/core/error.h"

namespace risorius::media::detail {

namespace {

constexpr int kPcmPiece = 1024;  // samples per packet; the number does not matter
// For AAC and Opus; transparent for speech and most music.
constexpr int kBitsPerChannel = 128 * 1000;

const char* encoder_of(Form form, const SoundForm& sound) {
    if (form == Form::kMp4) return "aac";
    if (form == Form::kWebm) return "libopus";
    return sound.bits == 16 ? "pcm_s16le" : sound.bits == 24 ? "pcm_s24le" : "pcm_f32le";
}

// The wanted rate when the encoder supports it, else 48 kHz. AAC has thirteen rates and Opus has five.
int rate_for(const AVCodec& encoder, int wanted_hz) {
    if (!encoder.supported_samplerates) return wanted_hz;
    for (const int* rate = encoder.supported_samplerates; *rate != 0; ++rate)
        if (*rate == wanted_hz) return wanted_hz;
    return 48000;
}

void put_sample(float value, AVSampleFormat format, std::uint8_t* to) {
    const double full = std::clamp(static_cast<double>(value), -1.0, 1.0);
    switch (av_get_packed_sample_fmt(format)) {
        case AV_SAMPLE_FMT_S16: {
            const auto out =
                static_cast<std::int16_t>(std::min(32767L, std::lround(full * 32768.0)));
            std::memcpy(to, &out, sizeof out);
            return;
        }
        case AV_SAMPLE_FMT_S32: {
            const auto out = static_cast<std::int32_t>(
                std::min<long long>(2147483647LL, std::llround(full * 2147483648.0)));
            std::memcpy(to, &out, sizeof out);
            return;
        }
        default:
            std::memcpy(to, &value, sizeof value);
    }
}

}  // namespace

void SoundCoder::check(int code, const char* what) const {
    if (code < 0) throw RunError(name_ + ": sound: " + what + ": " + ffmpeg_text(code));
}

SoundCoder::SoundCoder(std::string name, Form form, const Recording& recording,
                       std::int64_t offset_samples, bool headers_apart)
    : name_(std::move(name)) {
    const char* const wanted = encoder_of(form, recording);
    const AVCodec* encoder = avcodec_find_encoder_by_name(wanted);
    if (!encoder)
        throw RunError(name_ + ": the installed libavcodec has no " + wanted + " encoder");
    const int rate_hz = rate_for(*encoder, recording.rate_hz);
    channels_ = recording.channels;
    sound_.emplace(recording, rate_hz);
    first_ = std::llround(static_cast<double>(offset_samples) * rate_hz / recording.rate_hz);

    codec_.reset(avcodec_alloc_context3(encoder));
    piece_.reset(av_frame_alloc());
    if (!codec_ || !piece_) throw std::bad_alloc();
    codec_->sample_rate = rate_hz;
    codec_->sample_fmt = encoder->sample_fmts ? encoder->sample_fmts[0] : AV_SAMPLE_FMT_FLTP;
    av_channel_layout_default(&codec_->ch_layout, channels_);
    codec_->time_base = {1, rate_hz};
    codec_->thread_count = 1;
    codec_->flags |= AV_CODEC_FLAG_BITEXACT;
    if (headers_apart) codec_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    if (form == Form::kMp4 || form == Form::kWebm) {
        codec_->bit_rate = kBitsPerChannel * channels_;
        // At low rates, 128 kbit/s per channel are more than AAC allows (6144 bits per frame).
        codec_->bit_rate =
            std::min<std::int64_t>(codec_->bit_rate, std::int64_t{4} * rate_hz * channels_);
    }
    check(avcodec_open2(codec_.get(), encoder, nullptr), "the encoder does not start");
}

void SoundCoder::send(int length) {
    av_frame_unref(piece_.get());
    piece_->nb_samples = length;
    piece_->format = codec_->sample_fmt;
    piece_->sample_rate = codec_->sample_rate;
    check(av_channel_layout_copy(&piece_->ch_layout, &codec_->ch_layout), "no memory");
    check(av_frame_get_buffer(piece_.get(), 0), "no memory");
    const int size = av_get_bytes_per_sample(codec_->sample_fmt), channels = channels_;
    const bool planar = av_sample_fmt_is_planar(codec_->sample_fmt) != 0;
    heard_.resize(static_cast<std::size_t>(length) * static_cast<std::size_t>(channels));
    sound_->read(next_ - first_, length, heard_.data());
    for (int i = 0; i < length; ++i)
        for (int c = 0; c < channels; ++c) {
            const float value = heard_[static_cast<std::size_t>(i * channels + c)];
            std::uint8_t* to =
                planar ? piece_->extended_data[c] + std::ptrdiff_t{i} * size
                       : piece_->extended_data[0] + (std::ptrdiff_t{i} * channels + c) * size;
            put_sample(value, codec_->sample_fmt, to);
        }
    piece_->pts = next_;
    next_ += length;
    check(avcodec_send_frame(codec_.get(), piece_.get()), "the encoder gave up");
}

bool SoundCoder::send_until(std::int64_t sample) {
    const int length = codec_->frame_size > 0 ? codec_->frame_size : kPcmPiece;
    if (next_ + length > sample) return false;
    send(length);
    return true;
}

void SoundCoder::send_end(std::int64_t sample) {
    if (sample > next_) send(static_cast<int>(sample - next_));
    check(avcodec_send_frame(codec_.get(), nullptr), "the encoder gave up");
}

bool SoundCoder::receive(AVPacket* packet) {
    const int code = avcodec_receive_packet(codec_.get(), packet);
    if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return false;
    check(code, "the encoder gave up");
    return true;
}

}  // namespace risorius::media::detail
