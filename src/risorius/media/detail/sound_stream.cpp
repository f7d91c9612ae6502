// SPDX-License-Identifier: MIT
#include "risorius/media/detail/sound_stream.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <new>

#include "risorius/core/error.h"
#include "risorius/core/json_cursor.h"
#include "risorius/core/read_file.h"
#include "risorius/core/stand_in.h"

namespace risorius::media::detail {

namespace {

// Of FFmpeg's 300 formats those that hold sound themselves. Lists name other files, and those may name them again.
constexpr const char* kFormats = "wav,w64,flac,aiff,caf,au,mp3,aac,ogg,mov,matroska";

constexpr FileKind kSoundFile{"a sound file", std::numeric_limits<std::uint64_t>::max()};
// Floating point may exceed full scale. 24 dB above it is no sound any more, but a file that is read wrongly.
constexpr double kGreatest = 16;

double value_of(const std::uint8_t* at, AVSampleFormat format) {
    const auto value_as = [&](auto value) {
        std::memcpy(&value, at, sizeof value);
        return value;
    };
    switch (av_get_packed_sample_fmt(format)) {
        case AV_SAMPLE_FMT_U8:
            return (static_cast<double>(*at) - 128.0) / 128.0;
        case AV_SAMPLE_FMT_S16:
            return static_cast<double>(value_as(std::int16_t{})) / 32768.0;
        case AV_SAMPLE_FMT_S32:
            return static_cast<double>(value_as(std::int32_t{})) / 2147483648.0;
        case AV_SAMPLE_FMT_S64:
            return static_cast<double>(value_as(std::int64_t{})) / 9223372036854775808.0;
        case AV_SAMPLE_FMT_DBL:
            return value_as(double{});
        default:
            return static_cast<double>(value_as(float{}));
    }
}

int bits_of(AVSampleFormat format) {
    const AVSampleFormat coded = av_get_packed_sample_fmt(format);
    if (coded == AV_SAMPLE_FMT_FLT || coded == AV_SAMPLE_FMT_DBL) return 32;
    return coded == AV_SAMPLE_FMT_U8 || coded == AV_SAMPLE_FMT_S16 ? 16 : 24;
}

/// The decoder of integers that fill `bits` bits in a WAV file.
AVCodecID decoder_of_integers(int bits) {
    switch (bits) {
        case 8:
            return AV_CODEC_ID_PCM_U8;
        case 16:
            return AV_CODEC_ID_PCM_S16LE;
        case 24:
            return AV_CODEC_ID_PCM_S24LE;
        case 32:
            return AV_CODEC_ID_PCM_S32LE;
        case 64:
            return AV_CODEC_ID_PCM_S64LE;
        default:
            return AV_CODEC_ID_NONE;
    }
}

}  // namespace

SoundStream::SoundStream(const std::filesystem::path& file) : name_(file.string()) {
    silence_ffmpeg();
    check_file(file, kSoundFile);
    wav_ = read_wav_header(file);
    const std::string url = ffmpeg_url(file_to_read(file).string());
    format_ = avformat_alloc_context();
    if (format_) format_->format_whitelist = av_strdup(kFormats);
    if (!format_ || !format_->format_whitelist) {
        avformat_free_context(format_);
        throw std::bad_alloc();
    }
    // On failure FFmpeg frees the context.
    if (avformat_open_input(&format_, url.c_str(), nullptr, nullptr) < 0)
        throw Error(name_, "a sound file", "another kind of file, or one cut short");
    try {
        if (const AVStream* first = format_->nb_streams > 0 ? format_->streams[0] : nullptr;
            first && first->duration > 0 && first->codecpar->sample_rate > 0)
            promised_ =
                av_rescale_q(first->duration, first->time_base, {1, first->codecpar->sample_rate});
        if (avformat_find_stream_info(format_, nullptr) < 0)
            throw Error(name_, "a sound file", "another kind of file, or one cut short");
        open_decoder();
    } catch (...) {
        avformat_close_input(&format_);
        throw;
    }
}

SoundStream::~SoundStream() { avformat_close_input(&format_); }

void SoundStream::open_decoder() {
    const AVCodec* decoder = nullptr;
    const int index = av_find_best_stream(format_, AVMEDIA_TYPE_AUDIO, -1, -1, nullptr, 0);
    if (index < 0) throw Error(name_, "a file with sound", "none in it");
    stream_ = format_->streams[index];
    form_.container = format_->iformat->name;
    if (form_.container != "wav") wav_.reset();
    // FFmpeg chooses the decoder of a WAV file by the valid bits. The samples fill the bits of the container.
    if (wav_ && wav_->integers) {
        const AVCodecID whole = decoder_of_integers(wav_->container_bits);
        if (whole == AV_CODEC_ID_NONE)
            throw Error(name_, "samples of 8, 16, 24, 32 or 64 bits",
                        std::to_string(wav_->container_bits) + " bits");
        stream_->codecpar->codec_id = whole;
        stream_->codecpar->bits_per_coded_sample = wav_->container_bits;
    }
    decoder = avcodec_find_decoder(stream_->codecpar->codec_id);
    if (!decoder) throw Error(name_, "a file with sound", "none in it that can be decoded");
    codec_.reset(avcodec_alloc_context3(decoder));
    piece_.reset(av_frame_alloc());
    packet_.reset(av_packet_alloc());
    if (!codec_ || !piece_ || !packet_) throw std::bad_alloc();
    codec_->pkt_timebase = stream_->time_base;
    codec_->err_recognition = AV_EF_CRCCHECK | AV_EF_EXPLODE;
    if (avcodec_parameters_to_context(codec_.get(), stream_->codecpar) < 0 ||
        avcodec_open2(codec_.get(), decoder, nullptr) < 0)
        throw Error(name_, "sound that can be decoded", "a decoder that does not start");
    form_.rate_hz = codec_->sample_rate;
    form_.channels = codec_->ch_layout.nb_channels;
    form_.bits = bits_of(codec_->sample_fmt);
    if (form_.rate_hz < 1 || form_.channels < 1)
        throw Error(name_, "a file with sound", "no rate or no channels");
}

int SoundStream::check(int code) const {
    if (code < 0 && code != AVERROR(EAGAIN) && code != AVERROR_EOF)
        throw Error(name_, "sound that can be decoded", ffmpeg_text(code));
    return code;
}

/// Decodes the next piece. Returns false at the end.
bool SoundStream::receive() {
    for (;;) {
        const int got = check(avcodec_receive_frame(codec_.get(), piece_.get()));
        if (got >= 0) return true;
        if (got == AVERROR_EOF || draining_) return false;
        const int read = av_read_frame(format_, packet_.get());
        if (read < 0 || (format_->pb && format_->pb->error < 0)) {
            // An error of the disk is not the end of the file.
            const int error = format_->pb && format_->pb->error < 0 ? format_->pb->error : read;
            if (error != AVERROR_EOF)
                throw Error(name_, "sound that can be read", ffmpeg_text(error));
            draining_ = true;
            check(avcodec_send_packet(codec_.get(), nullptr));
            continue;
        }
        if (packet_->stream_index == stream_->index)
            check(avcodec_send_packet(codec_.get(), packet_.get()));
        av_packet_unref(packet_.get());
    }
}

void SoundStream::take(std::vector<float>& piece) {
    const auto format = static_cast<AVSampleFormat>(piece_->format);
    const int size = av_get_bytes_per_sample(format), channels = form_.channels;
    const bool planar = av_sample_fmt_is_planar(format) != 0;
    if (piece_->ch_layout.nb_channels != channels || piece_->sample_rate != form_.rate_hz)
        throw Error(name_, "one rate and number of channels throughout", "a change of them");
    for (int i = 0; i < piece_->nb_samples; ++i)
        for (int c = 0; c < channels; ++c) {
            const double value = value_of(
                planar ? piece_->extended_data[c] + std::ptrdiff_t{i} * size
                       : piece_->extended_data[0] + (std::ptrdiff_t{i} * channels + c) * size,
                format);
            if (!(std::abs(value) <= kGreatest))
                throw Error(name_ + ": at " +
                                format_number(static_cast<double>(taken_ + i) / form_.rate_hz) +
                                " s",
                            "samples of at most 24 dB above full scale",
                            std::isnan(value) ? "NaN" : format_number(value) + " of full scale");
            piece.push_back(static_cast<float>(value));
        }
    taken_ += piece_->nb_samples;
}

bool SoundStream::next(std::vector<float>& piece) {
    piece.clear();
    while (piece.empty()) {
        if (!receive()) return false;
        if (taken_ == 0 && piece_->best_effort_timestamp != AV_NOPTS_VALUE)
            start_s_ =
                static_cast<double>(piece_->best_effort_timestamp) * av_q2d(stream_->time_base);
        take(piece);
    }
    return true;
}

void SoundStream::check_whole(std::int64_t length) const {
    if (wav_) {
        if (wav_->missing_bytes > 0)
            throw Error(name_, "as much sound as its header says",
                        std::to_string(wav_->missing_bytes) + " bytes less");
    } else if (length < promised_) {
        throw Error(name_, std::to_string(promised_) + " samples, as its header says",
                    "only " + std::to_string(length));
    }
}

}  // namespace risorius::media::detail
