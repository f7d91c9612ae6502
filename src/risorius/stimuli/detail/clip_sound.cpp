// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/clip_sound.h"

#include <cmath>

#include "risorius/core/error.h"
#include "risorius/core/input_log.h"
#include "risorius/core/json_cursor.h"
#include "risorius/core/sha256.h"

namespace risorius::stimuli {

namespace fs = std::filesystem;

namespace {

constexpr double kMaxPeak_dbtp = -1;  // EBU R 128
constexpr double kAudible = 0.01, kWindow_s = 0.001;

/// The first sample of the first millisecond that is louder than a hundredth of the peak; none in silence.
std::optional<std::int64_t> first_audible(const media::Recording& recording) {
    const media::Sound all =
        media::part_of(recording, 0, static_cast<std::int64_t>(recording.length()));
    const std::size_t window = std::max<std::size_t>(
        1, static_cast<std::size_t>(std::llround(kWindow_s * recording.rate_hz)));
    const auto level = [&](std::size_t from) {
        float most = 0;
        for (std::size_t i = from; i < std::min(all.samples.size(), from + window); ++i)
            most = std::max(most, std::abs(all.samples[i]));
        return most;
    };
    float peak = 0;
    for (const float sample : all.samples) peak = std::max(peak, std::abs(sample));
    if (!(peak > 0)) return {};
    for (std::size_t from = 0; from < all.samples.size(); from += window)
        if (level(from) > kAudible * peak) return static_cast<std::int64_t>(from);
    return {};
}

}  // namespace

ClipSound measured_sound(const fs::path& file, const SoundPlace& where,
                         std::optional<double> lufs) {
    const media::Recording recording = media::open_recording(file);
    ClipSound out;
    out.file = file;
    out.name = where.name;
    out.sha256 = sha256_of_file(file);
    out.offset_samples = where.offset_samples;
    const double start_s = static_cast<double>(where.offset_samples) / recording.rate_hz,
                 length_s = static_cast<double>(recording.length()) / recording.rate_hz;
    if (start_s >= where.duration_s || start_s + length_s <= 0)
        throw Error(where.place,
                    "an audio_start_s with which the clip contains some of the recording",
                    format_number(start_s));
    if (const auto first = first_audible(recording))
        out.onset_s = static_cast<double>(out.offset_samples + *first) / recording.rate_hz;
    // Of the whole recording, so that the gain does not depend on when it is heard
    out.loudness = media::loudness_of(recording, 0, static_cast<std::int64_t>(recording.length()));
    if (!lufs) return out;
    if (!std::isfinite(out.loudness.integrated_lufs))
        throw Error(where.place, "at least 0.4 s of sound, to match its loudness",
                    where.name + ", which has less");
    out.gain_db = *lufs - out.loudness.integrated_lufs;
    out.loudness.integrated_lufs += out.gain_db;
    out.loudness.true_peak_dbtp += out.gain_db;
    if (out.loudness.true_peak_dbtp > kMaxPeak_dbtp) {
        const auto max_lufs =
            std::floor(10 * (*lufs - (out.loudness.true_peak_dbtp - kMaxPeak_dbtp))) / 10;
        throw Error(where.place,
                    "a loudness that leaves the peaks of " + where.name + " below -1 dBTP, " +
                        format_number(max_lufs) + " LUFS at most",
                    format_number(*lufs));
    }
    return out;
}

ClipSound SoundPlans::at(const design::Condition& condition, double duration_s,
                         std::optional<double> lufs, const std::string& place) {
    const fs::path file = fs::weakly_canonical(*condition.audio);
    const std::string key = file.string() + "\n" + format_number(condition.audio_start_s) + "\n" +
                            format_number(duration_s);
    if (const auto found = known_.find(key); found != known_.end()) return found->second;
    const int rate_hz = media::open_recording(*condition.audio).rate_hz;
    const ClipSound out =
        measured_sound(*condition.audio,
                       {.offset_samples = std::llround(condition.audio_start_s * rate_hz),
                        .duration_s = duration_s,
                        .name = condition.audio->string(),
                        .place = place},
                       lufs);
    return known_.emplace(key, out).first->second;
}

std::shared_ptr<const media::Recording> sound_of(const ClipSound& sound) {
    std::optional<ReadingFormerOutput> own;
    if (sound.keeps) own.emplace();
    auto recording = std::make_shared<media::Recording>(media::open_recording(sound.file));
    recording->gain_db = sound.gain_db;
    return recording;
}

media::Sound heard_of(const ClipSound& sound, double duration_s) {
    std::optional<ReadingFormerOutput> own;
    if (sound.keeps) own.emplace();
    const std::shared_ptr<const media::Recording> whole = sound_of(sound);
    return media::part_of(*whole, sound.offset_samples, std::llround(duration_s * whole->rate_hz));
}

}  // namespace risorius::stimuli
