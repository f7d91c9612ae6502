// SPDX-License-Identifier: MIT
#include "risorius/media/detail/sound.h"

#include <algorithm>
#include <cmath>

#include "risorius/core/error.h"
#include "risorius/media/detail/sound_stream.h"

namespace risorius::media {

using namespace detail;

namespace {

/// Of all channels: six hours in stereo. Some bytes of FLAC can stand for half a million samples.
constexpr std::int64_t kMostSamples = 2'000'000'000;

float amplified(double factor, float sample) { return static_cast<float>(factor * sample); }

[[noreturn]] void fail_as_changed(const Recording& recording) {
    throw Error(recording.file.string(), "a file that does not change",
                "another length than before");
}

/// Reads a recording and applies its gain.
class RecordingReader {
  public:
    explicit RecordingReader(const Recording& recording)
        : recording_(recording),
          stream_(recording.file),
          factor_(std::pow(10, recording.gain_db / 20)) {
        if (stream_.form().rate_hz != recording.rate_hz ||
            stream_.form().channels != recording.channels)
            fail_as_changed(recording);
    }

    /// The next samples, interleaved; false at the end.
    bool next(std::vector<float>& piece) {
        if (!stream_.next(piece)) {
            if (read_ != recording_.length()) fail_as_changed(recording_);
            return false;
        }
        read_ += static_cast<std::int64_t>(piece.size()) / recording_.channels;
        if (read_ > recording_.length()) fail_as_changed(recording_);
        if (recording_.gain_db != 0)
            for (float& sample : piece) sample = amplified(factor_, sample);
        return true;
    }

  private:
    Recording recording_;
    SoundStream stream_;
    double factor_;
    std::int64_t read_ = 0;
};

}  // namespace

Sound read_sound(const std::filesystem::path& file) {
    SoundStream stream(file);
    Sound sound;
    static_cast<SoundForm&>(sound) = stream.form();
    for (std::vector<float> piece; stream.next(piece);)
        sound.samples.insert(sound.samples.end(), piece.begin(), piece.end());
    sound.start_s = stream.start_s();
    if (sound.samples.empty()) throw Error(file.string(), "a file with sound", "no samples in it");
    return sound;
}

Recording open_recording(const std::filesystem::path& file) {
    SoundStream stream(file);
    Recording recording;
    static_cast<SoundForm&>(recording) = stream.form();
    recording.file = file;
    if (recording.container != "wav" && recording.container != "flac")
        throw Error(file.string(), "a WAV or FLAC file",
                    "one of " + risorius::in_quotes(recording.container));
    const auto check_length = [&](std::int64_t of_channel) {
        if (of_channel > kMostSamples / recording.channels)
            throw Error(file.string(), "at most 2e9 samples in all channels, six hours in stereo",
                        "more");
    };
    check_length(stream.promised());
    for (std::vector<float> piece; stream.next(piece);) {
        recording.samples_of_channel +=
            static_cast<std::int64_t>(piece.size()) / recording.channels;
        check_length(recording.samples_of_channel);
    }
    if (recording.length() == 0)
        throw Error(file.string(), "a file with sound", "no samples in it");
    stream.check_whole(recording.length());
    return recording;
}

void for_each_piece(const Recording& recording, std::int64_t offset, std::int64_t length,
                    const std::function<void(const float*, std::size_t)>& take) {
    constexpr std::int64_t kSilence = 4096;
    const std::vector<float> silence(static_cast<std::size_t>(kSilence * recording.channels), 0.0f);
    const auto be_silent = [&](std::int64_t count) {
        for (; count > 0; count -= kSilence)
            take(silence.data(), static_cast<std::size_t>(std::min(count, kSilence)));
    };
    const std::int64_t begin = std::clamp<std::int64_t>(offset, 0, length),
                       end = std::clamp<std::int64_t>(offset + recording.length(), begin, length);
    be_silent(begin);
    RecordingReader reader(recording);
    std::int64_t at = offset;  // of the piece, from the start of the part
    for (std::vector<float> piece; begin < end && at < end && reader.next(piece);) {
        const std::int64_t count = static_cast<std::int64_t>(piece.size()) / recording.channels;
        const std::int64_t first = std::max(at, begin), last = std::min(at + count, end);
        if (first < last)
            take(piece.data() + (first - at) * recording.channels,
                 static_cast<std::size_t>(last - first));
        at += count;
    }
    be_silent(length - end);
}

Sound part_of(const Recording& recording, std::int64_t offset, std::int64_t length) {
    Sound out;
    static_cast<SoundForm&>(out) = recording;
    for_each_piece(recording, offset, length, [&](const float* samples, std::size_t count) {
        out.samples.insert(out.samples.end(), samples,
                           samples + count * static_cast<std::size_t>(recording.channels));
    });
    return out;
}

struct ResampledRecording::Impl {
    RecordingReader reader;
    int channels;
    std::int64_t length;
    SwrPtr swr;                // none when the rate stays
    std::vector<float> piece;  // as read
    std::vector<float> ready;  // at the new rate; its first sample is number `first`
    std::int64_t first = 0;
    bool ended = false;

    Impl(const Recording& recording, int rate_hz)
        : reader(recording),
          channels(recording.channels),
          length(av_rescale_rnd(recording.length(), rate_hz, recording.rate_hz, AV_ROUND_UP)) {
        if (rate_hz == recording.rate_hz) return;
        AVChannelLayout layout{};
        av_channel_layout_default(&layout, channels);
        SwrContext* made = nullptr;
        const int code = swr_alloc_set_opts2(&made, &layout, AV_SAMPLE_FMT_FLT, rate_hz, &layout,
                                             AV_SAMPLE_FMT_FLT, recording.rate_hz, 0, nullptr);
        swr.reset(made);
        check(code < 0 || !swr ? std::min(code, -1) : swr_init(swr.get()));
    }

    static void check(int code) {
        if (code < 0) throw RunError("no conversion of sample rates: " + ffmpeg_text(code));
    }

    /// Converts `count` samples and what the filter holds; the end of the input without samples.
    void convert(const float* samples, int count) {
        const int room = swr_get_out_samples(swr.get(), count);
        check(room);
        const std::size_t before = ready.size();
        ready.resize(before + static_cast<std::size_t>(room) * static_cast<std::size_t>(channels));
        auto* to = reinterpret_cast<std::uint8_t*>(ready.data() + before);
        const auto* from = reinterpret_cast<const std::uint8_t*>(samples);
        const int got = swr_convert(swr.get(), &to, room, samples ? &from : nullptr, count);
        check(got);
        ready.resize(before + static_cast<std::size_t>(got) * static_cast<std::size_t>(channels));
    }

    /// Makes more samples ready. Returns false at the end.
    bool fill() {
        if (ended) return false;
        ended = !reader.next(piece);
        if (!swr)
            ready.insert(ready.end(), piece.begin(), piece.end());
        else
            convert(ended ? nullptr : piece.data(),
                    ended ? 0 : static_cast<int>(piece.size()) / channels);
        return true;
    }

    std::int64_t end() const { return first + static_cast<std::int64_t>(ready.size()) / channels; }

    /// Forgets what lies before `from`.
    void drop_until(std::int64_t from) {
        const std::int64_t count = std::clamp<std::int64_t>(from - first, 0, end() - first);
        ready.erase(ready.begin(), ready.begin() + count * channels);
        first += count;
    }
};

ResampledRecording::ResampledRecording(const Recording& recording, int rate_hz)
    : impl_(std::make_unique<Impl>(recording, rate_hz)) {}
ResampledRecording::~ResampledRecording() = default;
ResampledRecording::ResampledRecording(ResampledRecording&&) noexcept = default;
ResampledRecording& ResampledRecording::operator=(ResampledRecording&&) noexcept = default;

std::int64_t ResampledRecording::length() const { return impl_->length; }

void ResampledRecording::read(std::int64_t from, std::int64_t count, float* to) {
    Impl& in = *impl_;
    const std::int64_t channels = in.channels;
    std::fill(to, to + count * channels, 0.0f);
    const std::int64_t begin = std::max<std::int64_t>(from, 0),
                       end = std::min(from + count, in.length);
    if (begin >= end) return;
    in.drop_until(begin);
    while (in.end() < end) {
        if (!in.fill()) break;
        in.drop_until(begin);
    }
    const std::int64_t last = std::min(end, in.end());
    if (last > begin)
        std::copy(in.ready.begin() + (begin - in.first) * channels,
                  in.ready.begin() + (last - in.first) * channels, to + (begin - from) * channels);
}

}  // namespace risorius::media
