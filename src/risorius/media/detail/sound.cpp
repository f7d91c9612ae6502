// SPDX-License-Identifier: MIT
#include "risorius/media/detail/sound.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <new>

#include "risorius/core/error.h"
#include "risorius/media/detail/ffmpeg.h"

namespace risorius::media {

using namespace detail;

namespace {

class SoundFile {
  public:
    explicit SoundFile(const std::filesystem::path& file) : name_(file.string()) {
        silence_ffmpeg();
        std::error_code ignored;
        if (!std::filesystem::exists(file, ignored))
            throw Error(name_, "a sound file", "no such file");
        if (std::filesystem::is_directory(file, ignored))
            throw Error(name_, "a sound file", "a folder");
        if (avformat_open_input(&format_, ffmpeg_url(name_).c_str(), nullptr, nullptr) < 0 ||
            avformat_find_stream_info(format_, nullptr) < 0)
            throw Error(name_, "a sound file", "another kind of file, or one cut short");
    }
    ~SoundFile() {
        if (format_) avformat_close_input(&format_);
    }
    SoundFile(const SoundFile&) = delete;
    SoundFile& operator=(const SoundFile&) = delete;

    Sound read();

  private:
    void open_decoder();
    void take(Sound& sound) const;

    std::string name_;
    AVFormatContext* format_ = nullptr;
    AVStream* stream_ = nullptr;
    CodecPtr codec_;
    FramePtr piece_;
    PacketPtr packet_;
};

void SoundFile::open_decoder() {
    const AVCodec* decoder = nullptr;
    const int index = av_find_best_stream(format_, AVMEDIA_TYPE_AUDIO, -1, -1, &decoder, 0);
    if (index < 0 || !decoder) throw Error(name_, "a file with sound", "none in it");
    stream_ = format_->streams[index];
    codec_.reset(avcodec_alloc_context3(decoder));
    piece_.reset(av_frame_alloc());
    packet_.reset(av_packet_alloc());
    if (!codec_ || !piece_ || !packet_) throw std::bad_alloc();
    codec_->pkt_timebase = stream_->time_base;
    codec_->err_recognition = AV_EF_CRCCHECK | AV_EF_EXPLODE;
    if (avcodec_parameters_to_context(codec_.get(), stream_->codecpar) < 0 ||
        avcodec_open2(codec_.get(), decoder, nullptr) < 0)
        throw Error(name_, "sound that can be decoded", "a decoder that does not start");
}

float float_of(const std::uint8_t* at, AVSampleFormat format) {
    const auto value_as = [&](auto value) {
        std::memcpy(&value, at, sizeof value);
        return value;
    };
    switch (av_get_packed_sample_fmt(format)) {
        case AV_SAMPLE_FMT_U8:
            return (static_cast<float>(*at) - 128.0f) / 128.0f;
        case AV_SAMPLE_FMT_S16:
            return static_cast<float>(value_as(std::int16_t{})) / 32768.0f;
        case AV_SAMPLE_FMT_S32:
            return static_cast<float>(value_as(std::int32_t{}) / 2147483648.0);
        case AV_SAMPLE_FMT_DBL:
            return static_cast<float>(value_as(double{}));
        default:
            return value_as(float{});
    }
}

void SoundFile::take(Sound& sound) const {
    const auto format = static_cast<AVSampleFormat>(piece_->format);
    const int size = av_get_bytes_per_sample(format);
    const bool planar = av_sample_fmt_is_planar(format) != 0;
    if (piece_->ch_layout.nb_channels != sound.channels || piece_->sample_rate != sound.rate_hz)
        throw Error(name_, "one rate and number of channels throughout", "a change of them");
    for (int i = 0; i < piece_->nb_samples; ++i)
        for (int c = 0; c < sound.channels; ++c) {
            const std::uint8_t* at =
                planar ? piece_->extended_data[c] + std::ptrdiff_t{i} * size
                       : piece_->extended_data[0] + (std::ptrdiff_t{i} * sound.channels + c) * size;
            sound.samples.push_back(float_of(at, format));
        }
}

Sound SoundFile::read() {
    open_decoder();
    Sound sound;
    sound.rate_hz = codec_->sample_rate;
    sound.channels = codec_->ch_layout.nb_channels;
    sound.container = format_->iformat->name;
    const AVSampleFormat coded = av_get_packed_sample_fmt(codec_->sample_fmt);
    sound.bits = coded == AV_SAMPLE_FMT_FLT || coded == AV_SAMPLE_FMT_DBL  ? 32
                 : coded == AV_SAMPLE_FMT_U8 || coded == AV_SAMPLE_FMT_S16 ? 16
                                                                           : 24;
    const auto check = [&](int code) {
        if (code < 0 && code != AVERROR(EAGAIN) && code != AVERROR_EOF)
            throw Error(name_, "sound that can be decoded", ffmpeg_text(code));
        return code >= 0;
    };
    for (bool more = true; more;) {
        more = av_read_frame(format_, packet_.get()) >= 0;
        if (!more)
            check(avcodec_send_packet(codec_.get(), nullptr));
        else if (packet_->stream_index == stream_->index)
            check(avcodec_send_packet(codec_.get(), packet_.get()));
        av_packet_unref(packet_.get());
        while (check(avcodec_receive_frame(codec_.get(), piece_.get()))) {
            if (sound.samples.empty() && piece_->best_effort_timestamp != AV_NOPTS_VALUE)
                sound.start_s =
                    static_cast<double>(piece_->best_effort_timestamp) * av_q2d(stream_->time_base);
            take(sound);
        }
    }
    if (sound.samples.empty()) throw Error(name_, "a file with sound", "no samples in it");
    return sound;
}

/// Number of bytes that are missing according to a WAV file's header. FFmpeg would read the shorter file without an error.
std::int64_t bytes_missing_of_wav(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    const auto size = static_cast<std::int64_t>(std::filesystem::file_size(file));
    std::int64_t at = 12;  // after "RIFF", its length and "WAVE"
    char chunk[8];
    while (in.seekg(at) && in.read(chunk, sizeof chunk)) {
        std::int64_t length = 0;
        for (int i = 7; i >= 4; --i) length = length << 8 | static_cast<unsigned char>(chunk[i]);
        constexpr std::int64_t kUnknown = 0xffffffff;  // written by programs that write into a pipe
        if (std::memcmp(chunk, "data", 4) == 0)
            return length == kUnknown ? 0 : std::max<std::int64_t>(0, at + 8 + length - size);
        at += 8 + length + (length & 1);
    }
    return 0;
}

/// Number of samples according to a FLAC file's header.
std::int64_t samples_promised_by_flac(const std::filesystem::path& file, int rate_hz) {
    AVFormatContext* format = nullptr;
    if (avformat_open_input(&format, ffmpeg_url(file.string()).c_str(), nullptr, nullptr) < 0)
        return 0;
    const AVStream* stream = format->nb_streams > 0 ? format->streams[0] : nullptr;
    const std::int64_t promised =
        stream && stream->duration > 0
            ? av_rescale_q(stream->duration, stream->time_base, {1, rate_hz})
            : 0;
    avformat_close_input(&format);
    return promised;
}

void check_whole(const std::filesystem::path& file, const Sound& sound) {
    if (sound.container == "wav") {
        if (const std::int64_t missing = bytes_missing_of_wav(file); missing > 0)
            throw Error(file.string(), "as much sound as its header says",
                        std::to_string(missing) + " bytes less");
        return;
    }
    const std::int64_t promised = samples_promised_by_flac(file, sound.rate_hz);
    if (sound.length() < promised)
        throw Error(file.string(), std::to_string(promised) + " samples, as its header says",
                    "only " + std::to_string(sound.length()));
}

}  // namespace

Sound read_sound(const std::filesystem::path& file) { return SoundFile(file).read(); }

Sound read_recording(const std::filesystem::path& file) {
    Sound sound = read_sound(file);
    if (sound.container != "wav" && sound.container != "flac")
        throw Error(file.string(), "a WAV or FLAC file",
                    "one of " + risorius::in_quotes(sound.container));
    check_whole(file, sound);
    return sound;
}

Sound resampled(const Sound& sound, int rate_hz) {
    if (rate_hz == sound.rate_hz) return sound;
    AVChannelLayout layout{};
    av_channel_layout_default(&layout, sound.channels);
    SwrContext* made = nullptr;
    const int code = swr_alloc_set_opts2(&made, &layout, AV_SAMPLE_FMT_FLT, rate_hz, &layout,
                                         AV_SAMPLE_FMT_FLT, sound.rate_hz, 0, nullptr);
    const SwrPtr swr(made);
    if (code < 0 || !swr) throw RunError("no conversion of sample rates: " + ffmpeg_text(code));
    if (const int opened = swr_init(swr.get()); opened < 0)
        throw RunError("no conversion of sample rates: " + ffmpeg_text(opened));

    Sound out = sound;
    out.rate_hz = rate_hz;
    const std::int64_t length = av_rescale_rnd(sound.length(), rate_hz, sound.rate_hz, AV_ROUND_UP);
    // Room for samples that the filter still holds when the input has ended.
    out.samples.assign(static_cast<std::size_t>((length + 4096) * sound.channels), 0.0f);
    auto* to = reinterpret_cast<std::uint8_t*>(out.samples.data());
    const auto* from = reinterpret_cast<const std::uint8_t*>(sound.samples.data());
    const int room = static_cast<int>(length) + 4096;
    int got = swr_convert(swr.get(), &to, room, &from, static_cast<int>(sound.length()));
    if (got >= 0) {
        auto* rest = to + sizeof(float) * static_cast<std::size_t>(got) *
                              static_cast<std::size_t>(sound.channels);
        const int flushed = swr_convert(swr.get(), &rest, room - got, nullptr, 0);
        if (flushed > 0) got += flushed;
    }
    if (got < 0) throw RunError("no conversion of sample rates: " + ffmpeg_text(got));
    out.samples.resize(static_cast<std::size_t>(std::min<std::int64_t>(got, length)) *
                       static_cast<std::size_t>(sound.channels));
    return out;
}

}  // namespace risorius::media
