// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/clip_speech.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "risorius/core/input_log.h"
#include "risorius/core/json_object.h"

namespace risorius::stimuli {

namespace {

constexpr double kLipOnset = 0.05;  // of the range

/// When a measure of a table has changed by kLipOnset of its range, s from the first row; none when it does not change.
std::optional<double> onset_of(const animate::FrameRows& rows, const char* name, int fps) {
    const int column = rows.column(name);
    if (column < 0) return {};
    std::vector<double> away;
    for (int r = 0; r < rows.rows(); ++r)
        away.push_back(std::abs(rows.number(r, column) - rows.number(0, column)));
    double low = rows.number(0, column), high = low;
    for (int r = 0; r < rows.rows(); ++r) {
        low = std::min(low, rows.number(r, column));
        high = std::max(high, rows.number(r, column));
    }
    const double limit = kLipOnset * (high - low);
    for (std::size_t r = 1; limit > 0 && r < away.size(); ++r)
        if (away[r] >= limit) {
            const double part = (limit - away[r - 1]) / (away[r] - away[r - 1]);
            return (static_cast<double>(r) - 1 + std::clamp(part, 0.0, 1.0)) / fps;
        }
    return {};
}

/// A moment of the first stop or nasal of an utterance, s in the script.
template <typename Utterance, typename Moment>
std::optional<double> first_moment(const Utterance& placed, Moment moment) {
    for (const auto& phone : placed.utterance.phones)
        if (phone.release && phone.*moment)
            return placed.start_s + placed.utterance.seconds(*(phone.*moment));
    return {};
}

}  // namespace

std::optional<ClipSound> spoken_sound(const ClipPlan& plan, animate::RenderInputs& inputs,
                                      std::optional<double> lufs) {
    animate::RenderRequest request;
    request.script = plan.script_name;
    request.script_in_memory = JsonCursor::from_json(plan.condition.script, plan.script_name);
    request.out = "none.mkv";
    request.quality = plan.clips.quality;
    const animate::RenderJob job = animate::plan_render_job(request, inputs);
    if (job.speech.sound_file.empty()) return {};
    std::optional<ReadingFormerOutput> own;
    if (job.speech.keeps) own.emplace();
    ClipSound out = measured_sound(
        job.speech.sound_file,
        {.offset_samples = job.speech.sound_offset_samples,
         .duration_s = static_cast<double>(plan.frames) / plan.fps,
         .name = job.speech.keeps ? "speech.wav" : job.speech.sound_file.filename().string(),
         .place = plan.script_name},
        lufs);
    out.keeps = job.speech.keeps;
    return out;
}

Json speech_moments(const animate::RenderJob& job, const animate::FrameRows& rows) {
    const auto& said = job.speech.utterances;
    if (said.empty()) return {};
    using Phone = std::decay_t<decltype(said.front().utterance.phones.front())>;
    const auto seen =
        std::find_if(said.begin(), said.end(), [](const auto& one) { return one.face; });
    // An utterance without a face is there for its sound.
    auto heard = std::find_if(said.begin(), said.end(), [](const auto& one) { return !one.face; });
    if (heard == said.end()) heard = seen;
    std::optional<double> closure_s, release_s, burst_s, lips_s;
    if (seen != said.end()) {
        closure_s = first_moment(*seen, &Phone::closure);
        release_s = first_moment(*seen, &Phone::release);
        for (const char* name : {"lip_gap_mm", "lip_area_mm2"})
            if (const auto at_s = onset_of(rows, name, job.fps))
                lips_s = std::min(lips_s.value_or(INFINITY), *at_s);
    }
    if (heard != said.end() && !job.speech.sound_file.empty()) {
        burst_s = first_moment(*heard, &Phone::release);
        // The event may move its sound; noise begins before the speech, which stays where it is.
        const int rate_hz = heard->utterance.rate_hz;
        if (burst_s && !job.speech.keeps && rate_hz > 0)
            *burst_s += static_cast<double>(job.speech.sound_offset_samples -
                                            std::llround(heard->start_s * rate_hz)) /
                        rate_hz;
    }
    const auto or_null = [](const std::optional<double>& value) {
        return value ? Json(std::round(1e6 * *value) / 1e6) : Json();
    };
    return json_object(
        {{"lip_onset_s", or_null(lips_s)},
         {"closure_s", or_null(closure_s)},
         {"release_s", or_null(release_s)},
         {"burst_s", or_null(burst_s)},
         {"soa_ms",
          burst_s && release_s ? Json(std::round(1e6 * (*burst_s - *release_s)) / 1e3) : Json()}});
}

}  // namespace risorius::stimuli
