// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/clip_plan.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/core/sha256.h"
#include "risorius/core/version.h"
#include "risorius/media/sync_marks.h"
#include "risorius/media/video_writer.h"
#include "risorius/stimuli/detail/clip.h"
#include "risorius/stimuli/detail/clip_checks.h"
#include "risorius/stimuli/detail/clip_pictures.h"
#include "risorius/stimuli/detail/clip_speech.h"
#include "risorius/track/timeline.h"

namespace risorius::stimuli {

namespace fs = std::filesystem;
using design::ControlKind;

namespace {

// Estimates for two cores: seconds per clip, per frame and per pixel, and bytes per pixel
constexpr double kClip_s = 0.1, kFrame_s = 0.04, kPlayedFrame_s = 0.015, kPixel_s = 1e-7,
                 kByte_px = 0.03, kLosslessByte_px = 1.2;
constexpr int kOneKeyframe_s = 10;              // shorter clips have only one key frame
constexpr int kFastFilm_hz = 240, kFinest = 8;  // for controls that change the speed
constexpr double kRounding = 1e-9;              // of a number of frames
constexpr double kMaxHeld_bytes = 1.2e9;        // limit for frames that are kept in memory

}  // namespace

std::vector<Json::json_pointer> file_keys(const Json& script) {
    std::vector<Json::json_pointer> out;
    for (const char* key : {"/rig", "/emg/file", "/view/light/file"})
        if (const Json::json_pointer at(key); script.contains(at) && script.at(at).is_string())
            out.push_back(at);
    return out;
}

std::optional<int> keyframe_interval(const ClipPlan& plan) {
    if (plan.clips.ending == "mkv") return {};
    // A key frame is coded anew, which shows as a pulse in a face that does not move.
    return plan.clips.keyframe_interval.value_or(std::min(plan.frames, kOneKeyframe_s * plan.fps));
}

double ClipPlan::duration_s() const {
    return clips.pictures() ? clips.shown_s : static_cast<double>(frames) / fps;
}

int ClipPlan::finer() const {
    return condition.control.kind == ControlKind::kSpeed
               ? std::clamp(kFastFilm_hz / fps, 1, kFinest)
               : 1;
}

double ClipPlan::seconds() const {
    const double played = clips.pictures() ? kPlayedFrame_s * script_frames : 0;
    return kClip_s + played +
           (finer() + (lower ? 1 : 0)) * frames * (kFrame_s + kPixel_s * width_px * height_px);
}
double ClipPlan::megabytes() const {
    const double unmatched = luminance ? kLosslessByte_px : 0;
    const bool without_loss = clips.lossless || clips.ending == "mkv" || clips.pictures();
    return 1e-6 * frames * (unmatched + (without_loss ? kLosslessByte_px : kByte_px)) * width_px *
           height_px;
}

bool ClipPlan::has_aois() const {
    const design::Control& control = condition.control;
    return !clips.aois.empty() && control.kind != ControlKind::kMondrian &&
           !(control.kind == ControlKind::kPointLight && control.scattered);
}

std::string ClipPlan::shown_sha256() const {
    std::string shown = render_sha256;
    if (sound)
        shown += sound->sha256 + " " + std::to_string(sound->offset_samples) + " " +
                 format_number(sound->gain_db);
    return shown;
}

void ClipPlan::match(const media::Tone& matched) {
    tone = matched;
    content_sha256 = animate::sha256_of_text(json_text(json_object(
        {{"content", content_sha256}, {"gain", tone->gain}, {"offset", tone->offset}})));
}

namespace {

/// Whether the script moves the head in any frame.
bool moves_the_head(const track::ScriptDescription& script, const track::ChannelTable& channels,
                    const ClipPlan& plan) {
    const track::Timeline timeline(script, channels);
    for (int frame = 0; frame < plan.script_frames; ++frame) {
        const track::Drive drive = timeline.at(static_cast<double>(frame) / plan.fps);
        for (int k = static_cast<int>(track::Kinematic::kHeadYaw);
             k <= static_cast<int>(track::Kinematic::kHeadSide); ++k)
            if (drive.kinematic[static_cast<std::size_t>(k)] != 0) return true;
    }
    return false;
}

/// The name of a condition's script in messages: that of the design, in the folder to which its relative paths refer.
std::string script_name(const design::Condition& condition, const fs::path& design) {
    const std::string file = condition.folder == design.parent_path()
                                 ? design.filename().string()
                                 : "script of " + design.filename().string();
    return (condition.folder / (file + ", clip " + condition.clip)).string();
}

/// One checksum for rig, mesh and tables.
std::string sha256_of_rig(const animate::RigInput& rig) {
    std::string digests = rig.rig.sha256 + rig.mesh.sha256;
    for (const animate::InputFile& table : rig.tables) digests += table.sha256;
    return animate::sha256_of_text(digests);
}

/// Throws Error when the script is not suitable for the control.
void check_control(const ClipPlan& plan, const track::ScriptDescription& script,
                   const track::ChannelTable& channels, const std::string& place) {
    const design::ControlKind kind = plan.condition.control.kind;
    if (plan.clips.pictures() && (shows_other_order(kind) || kind == design::ControlKind::kSpeed))
        throw Error(place, "a control that a picture can show", plan.condition.control.name());
    if (plan.clips.pictures() && plan.condition.audio)
        throw Error(place, "no audio in a set of pictures", *plan.condition.audio);
    if (plan.clips.still_s.value_or(0) * plan.fps > plan.script_frames - 1 + kRounding)
        throw Error(place, "a script that lasts until clips/still_s",
                    format_number(static_cast<double>(plan.script_frames) / plan.fps) + " s");
    const double pixel_bytes = plan.luminance ? 8 : 4;  // of a frame that waits
    if (needs_all_frames(plan) &&
        pixel_bytes * (plan.finer() + (kind == design::ControlKind::kChimeric)) * plan.frames *
                plan.width_px * plan.height_px >
            kMaxHeld_bytes)
        throw Error(place,
                    "fewer or smaller frames for " +
                        (plan.is_control() ? "the control " + plan.condition.control.name()
                                           : std::string("a sound before the script")) +
                        ", which keeps them in memory",
                    std::to_string(plan.frames) + " of " + std::to_string(plan.width_px) + " x " +
                        std::to_string(plan.height_px));
    const double per_pattern = plan.fps / plan.condition.control.rate_hz;
    if (kind == design::ControlKind::kMondrian &&
        (per_pattern < 1 || std::abs(per_pattern - std::round(per_pattern)) > 1e-6))
        throw Error(place, "a rate_hz that divides the frames per second, for the control mondrian",
                    format_number(plan.condition.control.rate_hz) + " at " +
                        std::to_string(plan.fps) + " fps");
    if (kind == design::ControlKind::kFlipped && moves_the_head(script, channels, plan))
        throw Error(place, "a head that does not move, for the control flipped",
                    "one that the script moves");
}

/// The checksum of everything that the unmatched pictures depend on.
std::string render_sha256_of(const ClipPlan& plan, const std::string& rig_sha256) {
    const design::Condition& condition = plan.condition;
    Json rendered = json_object(
        {{"toolkit", kVersion},
         {"compiler", __VERSION__},
         {"script", condition.script},
         {"rig", rig_sha256},
         {"quality", plan.clips.quality},
         {"layers", plan.luminance.has_value()},
         {"flipped", condition.control.kind == design::ControlKind::kFlipped},
         {"within", plan.luminance && plan.luminance->within_face ? "face" : "picture"}});
    if (plan.clips.pictures())
        rendered["picture"] = plan.clips.still_s ? Json(*plan.clips.still_s) : Json("apex");
    if (plan.finer() > 1) rendered["finer"] = plan.finer();
    if (plan.luminance) rendered["bits"] = 16;
    for (const Json::json_pointer& key : file_keys(condition.script)) {
        rendered["script"][key] = "";
        const fs::path file = condition.script.at(key).get<std::string>();
        if (key.to_string() != "/rig")
            rendered["files"].push_back(
                sha256_of_file(file.is_relative() ? condition.folder / file : file));
    }
    return animate::sha256_of_text(json_text(rendered));
}

/// Changes when clips are made or measured in another way, so that older ones are made anew.
constexpr int kWayOfMaking = 4;

Json or_none(const std::optional<int>& value) { return value ? Json(*value) : Json(); }

/// The checksum of everything that the clip depends on.
std::string content_sha256_of(const ClipPlan& plan) {
    const design::Condition& condition = plan.condition;
    const design::ClipOptions& clips = plan.clips;
    Json content{{"film", plan.render_sha256},  // the key is part of the hashed text
                 {"control", condition.control.name()},
                 {"seed", condition.control.is_random() ? condition.seed : 0u},
                 {"ending", clips.ending},
                 {"crf", clips.crf ? Json(*clips.crf) : Json()},
                 {"lossless", clips.lossless},
                 {"landmarks", clips.landmarks},
                 {"keyframes", or_none(keyframe_interval(plan))},
                 {"made_by", kWayOfMaking},
                 {"photodiode", clips.photodiode ? Json(*clips.photodiode) : Json()}};
    // What the name of a control does not tell; older controls keep their checksums
    if (plan.lower) content["lower"] = plan.lower->render_sha256;
    if (const Json unnamed = condition.control.unnamed(); !unnamed.is_null())
        content["control_keys"] = unnamed;
    if (plan.has_aois())
        content["aois"] = json_object({{"names", clips.aois}, {"margin", clips.aoi_margin}});
    if (plan.luminance && plan.luminance->grey) content["grey"] = true;
    if (plan.lead_frames > 0) content["lead_frames"] = plan.lead_frames;
    if (plan.clips.pictures()) content["shown_s"] = plan.clips.shown_s;
    if (plan.sound)
        content["sound"] = json_object({{"file", plan.sound->sha256},
                                        {"offset_samples", plan.sound->offset_samples},
                                        {"gain_db", plan.sound->gain_db}});
    return animate::sha256_of_text(json_text(content));
}

/// Plans what the lower half of a chimeric clip shows. Throws Error when it is not as long or as large as the upper half.
std::shared_ptr<const ClipPlan> plan_lower_half(const ClipPlan& upper, double lead_s,
                                                const PlanShared& shared) {
    design::Condition condition = upper.condition;
    condition.script = std::exchange(condition.lower_script, Json());
    condition.control = {};
    condition.audio.reset();
    auto lower = std::make_shared<const ClipPlan>(plan_clip(condition, lead_s, shared));
    const auto shape = [](const ClipPlan& plan) {
        return std::to_string(plan.script_frames) + " frames at " + std::to_string(plan.fps) +
               " fps of " + std::to_string(plan.width_px) + " x " + std::to_string(plan.height_px);
    };
    if (shape(*lower) != shape(upper))
        throw Error(upper.script_name, "a lower half of " + shape(upper), shape(*lower));
    return lower;
}

}  // namespace

ClipPlan plan_clip(design::Condition planned, double lead_s, const PlanShared& shared) {
    const design::Design& design = shared.design;
    const design::ClipOptions& clips = design.clips;
    ClipPlan plan;
    plan.condition = std::move(planned);
    const design::Condition& condition = plan.condition;
    plan.design = design.name;
    plan.clips = clips;
    plan.luminance = design.match.luminance;
    plan.script_name = script_name(condition, design.file);
    const JsonCursor json = JsonCursor::from_json(condition.script, plan.script_name);
    const track::ScriptHeader header = track::read_script_header(json);
    const std::shared_ptr<const animate::RigInput> input = shared.inputs.rig(header.rig_file);
    const rig::RigDescription& rig = input->files.rig;
    const track::ChannelTable channels = rig.channels();
    const track::ScriptDescription script =
        track::read_script(json, channels, rig.facs, rig.expressions);
    plan.fps = header.fps;
    plan.lead_frames = static_cast<int>(std::ceil(lead_s * plan.fps - kRounding));
    plan.script_frames = header.frame_count();
    plan.frames = clips.pictures() ? 1 : plan.lead_frames + plan.script_frames;
    plan.width_px = header.view.width_px;
    plan.height_px = header.view.height_px;
    plan.transparent = header.view.transparent;
    for (std::size_t k = 0; k < 3; ++k)
        plan.background[k] =
            static_cast<std::uint8_t>(std::lround(255 * header.view.background_rgb[k]));
    check_control(plan, script, channels, plan.script_name);
    if (clips.photodiode)
        media::corner_named(*clips.photodiode, design.file.string() + ":/clips/photodiode");
    if (!clips.pictures())
        media::check_target(plan.script_name + "." + clips.ending,
                            {.width_px = plan.width_px,
                             .height_px = plan.height_px,
                             .fps = plan.fps,
                             .crf = clips.crf,
                             .keyframe_interval = clips.keyframe_interval,
                             .lossless = clips.lossless});
    if (condition.audio) {
        design::Condition heard = condition;
        heard.audio_start_s += static_cast<double>(plan.lead_frames) / plan.fps;
        plan.sound = shared.sounds.at(heard, static_cast<double>(plan.frames) / plan.fps,
                                      design.match.loudness_lufs, json.place());
    }
    if (!condition.audio && !script.says.empty() && !clips.pictures())
        plan.sound = spoken_sound(plan, shared.checks.quick_inputs(), design.match.loudness_lufs);
    const std::string rig_sha256 = sha256_of_rig(*input);
    plan.scene_sha256 = animate::sha256_of_text(
        json_text(Json{rig_sha256, clips.quality, condition.script.value("view", Json())}));
    shared.checks.check(plan, script, shared.inputs, plan.script_name);
    plan.render_sha256 = render_sha256_of(plan, rig_sha256);
    if (!condition.lower_script.is_null()) plan.lower = plan_lower_half(plan, lead_s, shared);
    plan.content_sha256 = content_sha256_of(plan);
    return plan;
}

}  // namespace risorius::stimuli
