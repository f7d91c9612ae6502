// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/chimera_halves.h"

#include "risorius/animate/landmark_run.h"
#include "risorius/animate/run_render_job.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/stimuli/detail/clip_pictures.h"
#include "risorius/stimuli/detail/expression_script.h"
#include "risorius/stimuli/detail/known_motion.h"
#include "risorius/stimuli/detail/picture_frame.h"

namespace risorius::stimuli {

namespace {

std::optional<animate::LandmarkFrames> twin_of(const animate::RenderJob& job,
                                               const ClipWorker& worker) {
    const auto without = animate::job_without_expression(job);
    if (!without) return {};
    return animate::play_landmarks(*without, worker.session, worker.monitor);
}

/// SeenMotion::full_mm of a half. `plan`: of the clip that shows all of it.
std::optional<double> full_mm_of(ClipPlan plan, const LandmarkChoice& choice,
                                 const ClipWorker& worker) {
    if (!plan.condition.units.empty()) return {};
    const std::optional<Json> script = expression_at_full_intensity(plan.condition.script);
    if (!script) return {};
    plan.condition.script = *script;
    const std::string key =
        json_text(*script) + plan.condition.folder.string() + "\n" + choice.name();
    return worker.settled.at(key, [&] {
        return settled_way_mm(render_job_of(plan, worker.folder / "none.mkv", {}, worker),
                              worker.session, {}, choice);
    });
}

SeenMotion still_half(SeenMotion half) {
    if (!half.seen_mm) half.seen_mm = 0;
    return half;
}

/// A half of a picture. `plan`: of the clip that shows all of it.
SeenMotion half_of_picture(const ClipPlan& plan, int frame, const LandmarkChoice& choice,
                           const ClipWorker& worker) {
    const animate::RenderJob job = render_job_of(plan, worker.folder / "none.mkv", {}, worker);
    const animate::LandmarkFrames frames =
        animate::play_landmarks(job, worker.session, worker.monitor);
    const SeenPicture picture = seen_picture(frames, twin_of(job, worker), frame, choice);
    SeenMotion out;
    out.seen_mm = picture.seen_mm;
    out.landmark = picture.landmark;
    out.full_mm = full_mm_of(plan, choice, worker);
    return out;
}

}  // namespace

LowerHalf lower_half(const ClipPlan& plan, const ClipWorker& worker) {
    const ClipPlan& lower = *plan.lower;
    LowerHalf out;
    if (lower.clips.pictures()) out.frame = picture_frame(lower, worker).frame;
    out.job = render_job_of(lower, worker.folder / "none.mkv", {}, worker, out.frame);
    if (ClipPictures::has_layers(plan)) out.job.view.background.transparent = true;
    out.job.view.deep = plan.luminance && out.job.view.show == render::Show::kSkin;
    const animate::RenderResult result = animate::run_render_job(
        out.job, worker.session, [&](Image image) { out.frames.push_back(std::move(image)); },
        worker.monitor);
    out.rows = animate::frame_rows(result.table);
    return out;
}

HalfMotions half_motions(const ClipPlan& plan, const animate::RenderJob& upper_job,
                         const animate::FrameRows& upper, const LowerHalf& lower,
                         const Chimera& chimera, const std::vector<int>& order,
                         const ClipWorker& worker) {
    const LandmarkChoice above = chimera.landmarks(upper, false),
                         below = chimera.landmarks(upper, true);
    HalfMotions out;
    out.upper = still_half(seen_motion(upper, twin_of(upper_job, worker), order, plan.fps, above));
    out.upper.full_mm = full_mm_of(plan, above, worker);
    out.lower =
        still_half(seen_motion(lower.rows, twin_of(lower.job, worker), order, plan.fps, below));
    out.lower.full_mm = full_mm_of(*plan.lower, below, worker);
    return out;
}

HalfMotions half_motions(const ClipPlan& plan, int frame, const animate::FrameRows& upper,
                         const LowerHalf& lower, const Chimera& chimera, const ClipWorker& worker) {
    return {.upper = half_of_picture(plan, frame, chimera.landmarks(upper, false), worker),
            .lower = half_of_picture(*plan.lower, lower.frame.value_or(0),
                                     chimera.landmarks(upper, true), worker)};
}

Json json_of_half(const SeenMotion& half) {
    const auto or_null = [](const auto& value) { return value ? Json(*value) : Json(); };
    return json_object({{"seen_mm", or_null(half.seen_mm)},
                        {"seen_landmark", half.landmark.empty() ? Json() : Json(half.landmark)},
                        {"full_mm", or_null(half.full_mm)},
                        {"seen_onset_frame", or_null(half.onset)},
                        {"seen_apex_frame", or_null(half.apex)}});
}

}  // namespace risorius::stimuli
