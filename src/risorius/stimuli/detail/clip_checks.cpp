// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/clip_checks.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "risorius/core/error.h"
#include "risorius/core/json_text.h"
#include "risorius/track/timeline.h"

namespace risorius::stimuli {

namespace {

constexpr double kLeastPxPerCycle = 4;  // an octave below half the sampling rate

Json says_of(const Json& script) {
    Json out = Json::array();
    if (script.contains("events"))
        for (const Json& event : script.at("events"))
            if (event.is_object() && event.contains("say")) out.push_back(event);
    return out;
}

animate::RenderJob planned_job(const ClipPlan& plan, animate::RenderInputs& inputs) {
    animate::RenderRequest request;
    request.script = plan.script_name;
    request.script_in_memory = JsonCursor::from_json(plan.condition.script, plan.script_name);
    request.out = "check.mkv";  // nothing is written
    request.quality = plan.clips.quality;
    return animate::plan_render_job(request, inputs);
}

}  // namespace

void ClipChecks::check(const ClipPlan& plan, const track::ScriptDescription& script,
                       animate::RenderInputs& inputs, const std::string& place) {
    check_render(plan, inputs);
    if (plan.condition.control.passes()) check_filter(plan, script, inputs, place);
}

void ClipChecks::check_render(const ClipPlan& plan, animate::RenderInputs& inputs) {
    const Json& script = plan.condition.script;
    const Json says = says_of(script);
    const std::string key = json_text(
        Json{plan.scene_sha256, plan.condition.folder.string(), script.value("view", Json()),
             script.value("pulls", Json()), says, says.empty() ? Json() : script.at("duration_s")});
    {
        const std::lock_guard lock(mutex_);
        if (rendered_.count(key) > 0) return;
    }
    planned_job(plan, says.empty() ? inputs : quick_);
    // Only what has passed: of several clips that are wrong in the same way, the first one is told.
    const std::lock_guard lock(mutex_);
    rendered_.insert(key);
}

const animate::PlannedLandmarks& ClipChecks::landmarks_of(const ClipPlan& plan,
                                                          animate::RenderInputs& inputs) {
    const std::lock_guard lock(mutex_);
    std::unique_ptr<const animate::PlannedLandmarks>& known = landmarks_[plan.scene_sha256];
    if (!known) {
        ClipPlan still = plan;
        if (still.condition.script.contains("events"))
            still.condition.script["events"] = Json::array();
        known = std::make_unique<const animate::PlannedLandmarks>(planned_job(still, inputs));
    }
    return *known;
}

void ClipChecks::check_filter(const ClipPlan& plan, const track::ScriptDescription& script,
                              animate::RenderInputs& inputs, const std::string& place) {
    const animate::PlannedLandmarks& landmarks = landmarks_of(plan, inputs);
    const track::ChannelTable channels = inputs.rig(script.header.rig_file)->files.rig.channels();
    const track::Timeline timeline(script, channels);
    const auto width_px = [&](int frame) {
        return landmarks.distance_px("zy_l", "zy_r",
                                     timeline.at(static_cast<double>(frame) / plan.fps));
    };
    double face_px = width_px(0);
    if (plan.clips.pictures()) {
        // The frame at the apex is not known yet, so all frames must do.
        int first = 0, last = plan.script_frames - 1;
        if (plan.clips.still_s)
            first = last = std::min(static_cast<int>(std::lround(*plan.clips.still_s * plan.fps)),
                                    plan.script_frames - 1);
        face_px = width_px(first);
        for (int frame = first; frame <= last; ++frame)
            face_px = std::min(face_px, width_px(frame));
    }
    const design::Control& control = plan.condition.control;
    const double finest = control.kind == design::ControlKind::kBandPass
                              ? control.upper_cycles_per_face
                              : control.cycles_per_face;
    if (face_px < kLeastPxPerCycle * finest)
        throw Error(place,
                    "a face of " + format_number(kLeastPxPerCycle * finest) +
                        " px or more for cycles_per_face " + format_number(finest) +
                        " of the control " + control.name(),
                    format_number(std::round(10 * face_px) / 10) + " px from zy_l to zy_r");
}

}  // namespace risorius::stimuli
