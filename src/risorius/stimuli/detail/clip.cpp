// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/clip.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "risorius/animate/frame_rows.h"
#include "risorius/animate/landmark_run.h"
#include "risorius/animate/run_render_job.h"
#include "risorius/core/error.h"
#include "risorius/core/input_log.h"
#include "risorius/core/json_text.h"
#include "risorius/core/output_set.h"
#include "risorius/core/read_file.h"
#include "risorius/core/version.h"
#include "risorius/media/image_file.h"
#include "risorius/media/sha256.h"
#include "risorius/media/sync_marks.h"
#include "risorius/media/video_reader.h"
#include "risorius/media/video_writer.h"
#include "risorius/media/wav_file.h"
#include "risorius/stimuli/detail/clip_pictures.h"
#include "risorius/stimuli/detail/expression_script.h"
#include "risorius/stimuli/detail/frame_columns.h"
#include "risorius/stimuli/detail/mirrored_rows.h"
#include "risorius/stimuli/detail/seen_motion.h"
#include "risorius/stimuli/detail/unmatched_render.h"
#include "risorius/track/timeline.h"

namespace risorius::stimuli {

namespace fs = std::filesystem;
using design::ControlKind;

namespace {

// Estimates for two cores: seconds per clip, per frame and per pixel, and bytes per pixel
constexpr double kClip_s = 0.1, kFrame_s = 0.04, kPixel_s = 1e-7, kByte_px = 0.03,
                 kLosslessByte_px = 1.2;
constexpr int kOneKeyframe_s = 10;        // shorter clips have only one key frame
constexpr double kMaxHeld_bytes = 0.6e9;  // limit for frames that are kept in memory

/// The positions in a script that name a file.
std::vector<Json::json_pointer> file_keys(const Json& script) {
    std::vector<Json::json_pointer> out;
    for (const char* key : {"/rig", "/emg/file", "/view/light/file"})
        if (const Json::json_pointer at(key); script.contains(at) && script.at(at).is_string())
            out.push_back(at);
    return out;
}

/// The script with its relative paths rewritten for another folder.
Json relocated(Json script, const fs::path& from, const fs::path& to) {
    for (const Json::json_pointer& key : file_keys(script)) {
        const fs::path file = script.at(key).get<std::string>();
        if (file.is_relative())
            script[key] =
                fs::relative(fs::absolute(from / file), fs::absolute(to)).generic_string();
    }
    return script;
}

fs::path script_file(const ClipPlan& plan) {
    return fs::path("code/scripts") / (plan.condition.clip + ".json");
}

std::string stem(const ClipPlan& plan) { return "stimuli/stim-" + plan.condition.clip; }

/// The suffix of BIDS for a video without and with sound.
std::string suffix(const ClipPlan& plan) { return plan.sound ? "_audiovideo" : "_video"; }

/// Whether the script moves the head in any frame.
bool moves_the_head(const track::ScriptDescription& script, const track::ChannelTable& channels,
                    const ClipPlan& plan) {
    const track::Timeline timeline(script, channels);
    for (int frame = 0; frame < plan.frames; ++frame) {
        const track::Drive drive = timeline.at(static_cast<double>(frame) / plan.fps);
        for (int k = static_cast<int>(track::Kinematic::kHeadYaw);
             k <= static_cast<int>(track::Kinematic::kHeadSide); ++k)
            if (drive.kinematic[static_cast<std::size_t>(k)] != 0) return true;
    }
    return false;
}

/// Frames from one key frame to the next; none for endings in which every frame is one.
std::optional<int> keyframe_interval(const ClipPlan& plan) {
    if (plan.clips.ending == "mkv") return {};
    // A key frame is coded anew, which shows as a pulse in a face that does not move.
    return plan.clips.keyframe_interval.value_or(std::min(plan.frames, kOneKeyframe_s * plan.fps));
}

Json finite_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(); }

/// Passes on the pictures of an unmatched render.
void show_matched(const UnmatchedRender& render, const ProgressMonitor& monitor,
                  ClipPictures& pictures) {
    const ReadingFormerOutput own;
    media::VideoReader reader(render.video);
    for (int frame = 0; frame < reader.frames(); ++frame) {
        monitor.report(static_cast<double>(frame) / reader.frames(), animate::kRendering);
        pictures.add(reader.frame(frame));
    }
}

/// What the sidecar says about a matched clip.
Json matched_luminance(const ClipPlan& plan, const UnmatchedRender& render,
                       const ClipPictures& pictures) {
    const media::Tone tone = plan.tone.value_or(media::Tone{});
    return {{"film_sha256", plan.render_sha256},
            {"within", plan.luminance->within_face ? "face" : "picture"},
            {"gain", tone.gain},
            {"offset", tone.offset},
            {"before", json_of(render.luminance)},
            {"colours", render.colours},
            {"after", json_of(pictures.luminance())},
            {"cut_off", pictures.cut_off()}};
}

}  // namespace

Json portable_record(const animate::RunRecord& record) {
    Json json = record.json();
    for (const char* key : {"out", "out_sha256", "timing", "script"}) json.erase(key);
    const auto name_only = [](Json& file) {
        file["file"] = fs::path(file.at("file").get<std::string>()).filename().generic_string();
    };
    for (const char* key : {"rig", "mesh"}) name_only(json[key]);
    for (const char* key : {"tables", "recordings"})
        for (Json& file : json[key]) name_only(file);
    return json;
}

std::string text_of_file(const fs::path& file) {
    return read_file(file, {"a text file", 256 * kMegabyte});
}

double ClipPlan::seconds() const {
    return kClip_s + frames * (kFrame_s + kPixel_s * width_px * height_px);
}
double ClipPlan::megabytes() const {
    const double unmatched = luminance ? kLosslessByte_px : 0;
    return 1e-6 * frames *
           (unmatched + (clips.lossless || clips.ending == "mkv" ? kLosslessByte_px : kByte_px)) *
           width_px * height_px;
}

std::string ClipPlan::shown_sha256() const {
    std::string shown = render_sha256;
    if (sound)
        shown += sound->sha256 + " " + std::to_string(sound->offset_samples) + " " +
                 format_number(sound->gain_db);
    return shown;
}

double SettledMotions::at(const std::string& key, const std::function<double()>& measure) {
    {
        const std::lock_guard lock(mutex_);
        if (const auto found = known_.find(key); found != known_.end()) return found->second;
    }
    const double value = measure();
    const std::lock_guard lock(mutex_);
    return known_.emplace(key, value).first->second;
}

void ClipPlan::match(const media::Tone& matched) {
    tone = matched;
    content_sha256 = animate::sha256_of_text(json_text(
        Json{{"content", content_sha256}, {"gain", tone->gain}, {"offset", tone->offset}}));
}

namespace {

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
    if (needs_all_frames(plan) &&
        4.0 * plan.frames * plan.width_px * plan.height_px > kMaxHeld_bytes)
        throw Error(place,
                    "fewer or smaller frames for the control " + plan.condition.control.name() +
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
    Json rendered{{"toolkit", kVersion},
                  {"compiler", __VERSION__},
                  {"script", condition.script},
                  {"rig", rig_sha256},
                  {"quality", plan.clips.quality},
                  {"layers", plan.luminance.has_value()},
                  {"flipped", condition.control.kind == design::ControlKind::kFlipped},
                  {"within", plan.luminance && plan.luminance->within_face ? "face" : "picture"}};
    for (const Json::json_pointer& key : file_keys(condition.script)) {
        rendered["script"][key] = "";
        const fs::path file = condition.script.at(key).get<std::string>();
        if (key.to_string() != "/rig")
            rendered["files"].push_back(
                media::sha256_of_file(file.is_relative() ? condition.folder / file : file));
    }
    return animate::sha256_of_text(json_text(rendered));
}

/// Changes when clips are made or measured in another way, so that older ones are made anew.
constexpr int kWayOfMaking = 2;

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
    if (const Json unnamed = condition.control.unnamed(); !unnamed.is_null())
        content["control_keys"] = unnamed;
    if (plan.sound)
        content["sound"] = {{"file", plan.sound->sha256},
                            {"offset_samples", plan.sound->offset_samples},
                            {"gain_db", plan.sound->gain_db}};
    return animate::sha256_of_text(json_text(content));
}

}  // namespace

ClipPlan plan_clip(const design::Condition& condition, const design::Design& design,
                   animate::RenderInputs& inputs, SoundPlans& sounds) {
    const design::ClipOptions& clips = design.clips;
    ClipPlan plan;
    plan.condition = condition;
    plan.clips = clips;
    plan.luminance = design.match.luminance;
    plan.script_name = script_name(condition, design.file);
    const JsonCursor json = JsonCursor::from_json(condition.script, plan.script_name);
    const track::ScriptHeader header = track::read_script_header(json);
    const std::shared_ptr<const animate::RigInput> input = inputs.rig(header.rig_file);
    const rig::RigDescription& rig = input->files.rig;
    const track::ChannelTable channels = rig.channels();
    const track::ScriptDescription script =
        track::read_script(json, channels, rig.facs, rig.expressions);
    plan.frames = header.frame_count();
    plan.fps = header.fps;
    plan.width_px = header.view.width_px;
    plan.height_px = header.view.height_px;
    plan.transparent = header.view.transparent;
    for (std::size_t k = 0; k < 3; ++k)
        plan.background[k] =
            static_cast<std::uint8_t>(std::lround(255 * header.view.background_rgb[k]));
    check_control(plan, script, channels, json.place());
    if (clips.photodiode) media::corner_named(*clips.photodiode, "clips/photodiode");
    media::check_target("clips." + clips.ending, {.width_px = plan.width_px,
                                                  .height_px = plan.height_px,
                                                  .fps = plan.fps,
                                                  .crf = clips.crf,
                                                  .keyframe_interval = clips.keyframe_interval,
                                                  .lossless = clips.lossless});
    if (condition.audio)
        plan.sound = sounds.at(condition, static_cast<double>(plan.frames) / plan.fps,
                               design.match.loudness_lufs, json.place());
    const std::string rig_sha256 = sha256_of_rig(*input);
    plan.scene_sha256 = animate::sha256_of_text(
        json_text(Json{rig_sha256, clips.quality, condition.script.value("view", Json())}));
    plan.render_sha256 = render_sha256_of(plan, rig_sha256);
    plan.content_sha256 = content_sha256_of(plan);
    return plan;
}

std::vector<fs::path> ClipFiles::listed() const {
    std::vector<fs::path> files{script, strip, video, events, columns};
    if (!sound.empty()) files.push_back(sound);
    return files;
}

ClipFiles clip_files(const ClipPlan& plan) {
    return {script_file(plan),
            fs::path("overview") / (plan.condition.clip + ".png"),
            stem(plan) + suffix(plan) + "." + plan.clips.ending,
            stem(plan) + "_annot-frames_events.tsv",
            stem(plan) + "_annot-frames_events.json",
            plan.sound ? fs::path(stem(plan) + "_audio.wav") : fs::path(),
            stem(plan) + suffix(plan) + ".json"};
}

Json clip_record(const ClipPlan& plan, const fs::path& folder) {
    const ReadingFormerOutput former;
    return JsonCursor::read_file(folder / clip_files(plan).sidecar).json();
}

bool is_made(const ClipPlan& plan, const fs::path& folder) {
    const ReadingFormerOutput former;
    const ClipFiles files = clip_files(plan);
    if (!fs::exists(folder / files.sidecar)) return false;
    try {
        const Json record = clip_record(plan, folder);
        if (record.value("content_sha256", "") != plan.content_sha256) return false;
        for (const fs::path& file : files.listed())
            if (!fs::exists(folder / file) || record.at("files").value(file.generic_string(), "") !=
                                                  media::sha256_of_file(folder / file))
                return false;
        return true;
    } catch (const std::exception&) {
        return false;  // another or an incomplete file: the clip is made again
    }
}

animate::RenderJob render_job_of(const ClipPlan& plan, const fs::path& out,
                                 const media::VideoOptions& coding, const ClipWorker& worker) {
    animate::RenderRequest request;
    request.script = plan.script_name;
    request.script_in_memory = JsonCursor::from_json(plan.condition.script, plan.script_name);
    request.out = out;
    request.video = coding;
    request.quality = plan.clips.quality;
    request.landmarks = true;  // what is seen to move is measured on them
    request.threads = worker.threads;
    request.renders_at_once = worker.clips_at_once;
    request.flipped_motion = plan.condition.control.kind == design::ControlKind::kFlipped;
    return animate::plan_render_job(request, worker.inputs);
}

namespace {

/// The script as it is played, for code/scripts.
std::string clip_script(const ClipPlan& plan, const fs::path& folder) {
    const fs::path below = (folder / script_file(plan)).parent_path();
    return json_text(relocated(plan.condition.script, plan.condition.folder, below), 2) + "\n";
}

/// The unmatched render of a clip: an existing one, or a new one.
UnmatchedRender unmatched_render_for(const ClipPlan& plan, const ClipWorker& worker) {
    std::optional<UnmatchedRender> render = find_unmatched_render(plan, worker.folder);
    if (!render) {
        make_unmatched_render(plan, worker);
        render = find_unmatched_render(plan, worker.folder);
    }
    if (!render) throw RunError(plan.condition.clip + ": its unmatched render is missing");
    return *std::move(render);
}

/// The content of a clip, and what the sidecar records about it.
struct ShownClip {
    animate::FrameRows rows;
    std::vector<int> order;  ///< for each frame of the clip: the frame of the script
    SeenMotion motion;
    std::optional<double> commanded_onset_s, commanded_apex_s;
    Json run, luminance;  ///< luminance: null if it is not matched
};

/// When the strongest expression of a script is told to begin and to be complete.
void find_commanded(const track::ScriptDescription& script, ShownClip& shown) {
    const track::ExpressionEvent* strongest = nullptr;
    for (const track::ExpressionEvent& event : script.expressions) {
        if (!strongest || event.intensity > strongest->intensity) strongest = &event;
        shown.commanded_onset_s =
            std::min(shown.commanded_onset_s.value_or(event.start_s), event.start_s);
    }
    if (strongest) shown.commanded_apex_s = strongest->start_s + strongest->onset_s;
}

/// SeenMotion::full_mm of a clip.
std::optional<double> full_motion_mm(const ClipPlan& plan, const ClipWorker& worker) {
    const std::optional<Json> script = expression_at_full_intensity(plan.condition.script);
    if (!script) return {};
    ClipPlan full = plan;
    full.condition.script = *script;
    const std::string key = json_text(*script) + plan.condition.folder.string();
    return worker.settled.at(key, [&] {
        return largest_way_mm(animate::settled_landmarks(
            render_job_of(full, worker.folder / "none.mkv", {}, worker), worker.session));
    });
}

/// Renders the clip, or takes its pictures from an unmatched render, and applies the control.
ShownClip show_clip(const ClipPlan& plan, const animate::RenderJob& job,
                    const std::optional<UnmatchedRender>& unmatched, const ClipWorker& worker,
                    ClipPictures& pictures) {
    ShownClip shown;
    if (unmatched) {
        shown.run = unmatched->run;
        shown.rows = animate::frame_rows(unmatched->table);
        pictures.know(shown.rows);
        show_matched(*unmatched, worker.monitor, pictures);
    } else {
        const animate::RenderResult result = animate::run_render_job(
            job, worker.session, [&](Image image) { pictures.add(std::move(image)); },
            worker.monitor);
        shown.run = portable_record(result.record);
        shown.rows = animate::frame_rows(result.table);
    }
    std::optional<animate::LandmarkFrames> twin;
    if (const auto without = animate::job_without_expression(job))
        twin = animate::play_landmarks(*without, worker.session, worker.monitor);
    const design::Control& control = plan.condition.control;
    const auto order_with = [&](int apex) {
        return design::frame_order(control, job.frames, apex, plan.condition.seed);
    };
    int apex = 0;
    if (control.kind == ControlKind::kApex) {
        std::vector<int> forwards(static_cast<std::size_t>(job.frames));
        std::iota(forwards.begin(), forwards.end(), 0);
        apex = seen_motion(shown.rows, twin, forwards, plan.fps).apex.value_or(0);
    }
    shown.order = order_with(apex);
    // A mask shows no face.
    if (control.kind != ControlKind::kMondrian)
        shown.motion = seen_motion(shown.rows, twin, shown.order, plan.fps);
    if (control.kind == ControlKind::kMirrored)
        shown.motion.landmark = other_side(shown.motion.landmark);
    if (shown.motion.seen_mm) shown.motion.full_mm = full_motion_mm(plan, worker);
    if (std::is_sorted(shown.order.begin(), shown.order.end()) && shown.motion.seen_mm)
        find_commanded(job.script, shown);
    pictures.know(shown.rows);
    pictures.finish(shown.order);
    if (unmatched) shown.luminance = matched_luminance(plan, *unmatched, pictures);
    return shown;
}

/// The sidecar without the checksums of the files.
Json sidecar_of(const ClipPlan& plan, ShownClip shown, ClipPictures& pictures) {
    const auto or_null = [](const auto& value) { return value ? Json(*value) : Json(); };
    Json motion = json_of(shown.motion, pictures.pixel_onset());
    motion["commanded_onset_s"] = or_null(shown.commanded_onset_s);
    motion["commanded_apex_s"] = or_null(shown.commanded_apex_s);
    Json record{{"format", "risorius-clip"},
                {"version", 1},
                {"stim_id", plan.condition.clip},
                {"set", plan.condition.set},
                {"control", plan.condition.control.name()},
                {"of", plan.condition.of},
                {"values", Json::object()},
                {"frames", plan.frames},
                {"fps", plan.fps},
                {"duration_s", static_cast<double>(plan.frames) / plan.fps},
                {"movement_onset_frame", or_null(shown.motion.onset)},
                {"apex_frame", or_null(shown.motion.apex)},
                {"motion", std::move(motion)},
                {"pictures_sha256", pictures.sha256()},
                {"content_sha256", plan.content_sha256},
                {"files", Json::object()},
                {"run", std::move(shown.run)}};
    for (const auto& [name, value] : plan.condition.values) record["values"][name] = value;
    if (plan.sound)
        record["audio"] = {{"file", plan.sound->file.filename().generic_string()},
                           {"sha256", plan.sound->sha256},
                           {"offset_samples", plan.sound->offset_samples},
                           {"gain_db", plan.sound->gain_db},
                           {"loudness_lufs", finite_or_null(plan.sound->loudness.integrated_lufs)},
                           {"true_peak_dbtp", finite_or_null(plan.sound->loudness.true_peak_dbtp)}};
    if (!shown.luminance.is_null()) record["luminance"] = std::move(shown.luminance);
    return record;
}

}  // namespace

void make_clip(const ClipPlan& plan, const ClipWorker& worker) {
    const ClipFiles files = clip_files(plan);
    const fs::path& folder = worker.folder;
    std::optional<UnmatchedRender> unmatched;
    if (plan.luminance) unmatched = unmatched_render_for(plan, worker);
    OutputSet outputs(folder, OutputSet::Then::kRunGoesOn);
    // The sidecar first: it tells that the folder is one of `batch`.
    const fs::path sidecar = outputs.file(folder / files.sidecar);
    std::map<fs::path, fs::path> written;
    for (const fs::path& file : files.listed()) written[file] = outputs.file(folder / file);
    write_file(written[files.script], clip_script(plan, folder));

    const fs::path video_file = written[files.video];
    media::VideoOptions coding;
    coding.crf = plan.clips.crf;
    coding.lossless = plan.clips.lossless;
    coding.keyframe_interval = keyframe_interval(plan);
    coding.still = shows_one_picture(plan.condition.control.kind) && !plan.clips.photodiode;
    animate::RenderJob job = render_job_of(plan, video_file, coding, worker);
    if (ClipPictures::has_layers(plan)) job.view.background.transparent = true;
    if (plan.sound) {
        job.video.sound = sound_of(*plan.sound);
        job.video.sound_offset_samples = plan.sound->offset_samples;
    }
    media::VideoWriter video(video_file, job.video);
    ClipPictures pictures(plan, video);
    ShownClip shown = show_clip(plan, job, unmatched, worker, pictures);

    // All files appear together, or none.
    video.finish();
    const std::string table = events_table(shown.rows, shown.order, pictures.measures(), plan);
    write_file(written[files.events], table);
    write_file(written[files.columns], frame_columns(table, plan));
    media::write_png(pictures.strip(), written[files.strip]);
    if (plan.sound)
        media::write_wav(heard_of(*plan.sound, static_cast<double>(plan.frames) / plan.fps),
                         written[files.sound]);
    Json record = sidecar_of(plan, std::move(shown), pictures);
    for (const fs::path& file : files.listed())
        record["files"][file.generic_string()] = media::sha256_of_file(written[file]);
    write_file(sidecar, json_text(record, 2) + "\n");
    worker.monitor.throw_if_stopped();
    outputs.commit();
    if (unmatched && !plan.render_is_shared) remove_unmatched_render(plan, folder);
}

}  // namespace risorius::stimuli
