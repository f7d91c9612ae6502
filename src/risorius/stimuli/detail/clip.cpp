// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/clip.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "risorius/animate/frame_rows.h"
#include "risorius/animate/landmark_run.h"
#include "risorius/animate/run_render_job.h"
#include "risorius/core/error.h"
#include "risorius/core/input_log.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/core/output_set.h"
#include "risorius/core/read_file.h"
#include "risorius/core/sha256.h"
#include "risorius/media/image_file.h"
#include "risorius/media/video_reader.h"
#include "risorius/media/video_writer.h"
#include "risorius/media/wav_file.h"
#include "risorius/stimuli/detail/aois.h"
#include "risorius/stimuli/detail/chimera_halves.h"
#include "risorius/stimuli/detail/clip_pictures.h"
#include "risorius/stimuli/detail/clip_plan.h"
#include "risorius/stimuli/detail/clip_speech.h"
#include "risorius/stimuli/detail/expression_script.h"
#include "risorius/stimuli/detail/frame_columns.h"
#include "risorius/stimuli/detail/known_motion.h"
#include "risorius/stimuli/detail/mirrored_rows.h"
#include "risorius/stimuli/detail/picture_frame.h"
#include "risorius/stimuli/detail/seen_motion.h"
#include "risorius/stimuli/detail/unmatched_render.h"

namespace risorius::stimuli {

namespace fs = std::filesystem;
using design::ControlKind;

namespace {

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

fs::path script_file(const ClipPlan& plan, const char* half = "") {
    return fs::path("code/scripts") / (plan.folder + plan.condition.clip + half + ".json");
}

std::string stem(const ClipPlan& plan) {
    return "stimuli/" + plan.folder + "stim-" + plan.condition.clip;
}

std::string suffix(const ClipPlan& plan) { return std::string("_") + clip_type(plan); }

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
    Json out = json_object({{"film_sha256", plan.render_sha256},
                            {"within", plan.luminance->within_face ? "face" : "picture"},
                            {"gain", plan.mapped ? Json() : Json(tone.gain)},
                            {"offset", plan.mapped ? Json() : Json(tone.offset)},
                            {"before", json_of(render.luminance)},
                            {"colours", render.colours},
                            {"after", json_of(pictures.luminance())},
                            {"cut_off", pictures.cut_off()}});
    if (plan.mapped) out.update(pictures.map_report());
    return out;
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

double SettledMotions::at(const std::string& key, const std::function<double()>& measure) {
    {
        const std::lock_guard lock(mutex_);
        if (const auto found = known_.find(key); found != known_.end()) return found->second;
    }
    const double value = measure();
    const std::lock_guard lock(mutex_);
    return known_.emplace(key, value).first->second;
}

std::vector<fs::path> ClipFiles::listed() const {
    std::vector<fs::path> files{script, strip, video, events, columns};
    if (!lower_script.empty()) files.push_back(lower_script);
    if (!sound.empty()) files.push_back(sound);
    if (!aois.empty()) files.insert(files.end(), {aois, aoi_columns, aoi_key_frames, aoi_ias});
    return files;
}

std::string folder_of_clips(std::size_t index) {
    char name[32];
    std::snprintf(name, sizeof name, "b%03zu/", index / kClipsPerFolder);
    return name;
}

bool is_folder_of_clips(const std::string& name) {
    return name.size() >= 4 && name[0] == 'b' &&
           std::all_of(name.begin() + 1, name.end(), [](char c) { return c >= '0' && c <= '9'; });
}

const char* clip_type(const ClipPlan& plan) {
    if (plan.clips.pictures()) return "image";
    return plan.sound ? "audiovideo" : "video";
}

ClipFiles clip_files(const ClipPlan& plan) {
    const auto only = [&](const std::string& file) {
        return plan.has_aois() ? fs::path(file) : fs::path();
    };
    return {script_file(plan),
            fs::path("overview") / (plan.folder + plan.condition.clip + ".png"),
            stem(plan) + suffix(plan) + "." + plan.clips.ending,
            stem(plan) + "_annot-frames_events.tsv",
            stem(plan) + "_annot-frames_events.json",
            plan.lower ? script_file(plan, "_lower") : fs::path(),
            plan.sound ? fs::path(stem(plan) + "_audio.wav") : fs::path(),
            only(stem(plan) + "_annot-aois_events.tsv"),
            only(stem(plan) + "_annot-aois_events.json"),
            only("aois/" + plan.folder + plan.condition.clip + "_tobii.json"),
            only("aois/" + plan.folder + plan.condition.clip + ".ias"),
            stem(plan) + suffix(plan) + ".json"};
}

std::string file_in_stimuli(const ClipPlan& plan) {
    return plan.folder + clip_files(plan).video.filename().generic_string();
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
                                                  sha256_of_file(folder / file))
                return false;
        return true;
    } catch (const std::exception&) {
        return false;  // another or an incomplete file: the clip is made again
    }
}

animate::RenderJob render_job_of(const ClipPlan& plan, const fs::path& out,
                                 const media::VideoOptions& coding, const ClipWorker& worker,
                                 std::optional<int> frame) {
    animate::RenderRequest request;
    request.script = plan.script_name;
    request.script_in_memory = JsonCursor::from_json(plan.condition.script, plan.script_name);
    request.out = out;
    request.video = coding;
    if (frame) request.times_s = {static_cast<double>(*frame) / plan.fps};
    request.quality = plan.clips.quality;
    request.landmarks = true;  // what is seen to move is measured on them
    request.threads = worker.threads;
    request.renders_at_once = worker.clips_at_once;
    if (plan.finer() > 1) request.fps = plan.finer() * plan.fps;
    request.flipped_motion = plan.condition.control.kind == design::ControlKind::kFlipped;
    return animate::plan_render_job(request, worker.inputs);
}

namespace {

/// The script as it is played, for code/scripts.
std::string clip_script(const ClipPlan& plan, const Json& script, const fs::path& folder) {
    const fs::path below = (folder / script_file(plan)).parent_path();
    return json_text(relocated(script, plan.condition.folder, below), 2) + "\n";
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
    std::vector<int> order;  ///< for each frame of the clip: its row
    int first_source = 0;    ///< the frame of the script in the first row
    SeenMotion motion;
    std::optional<double> commanded_onset_s, commanded_apex_s;
    Json run, luminance;                ///< luminance: null if it is not matched
    Json seam;                          ///< of a chimeric clip; null in others
    Json speech;                        ///< null when nothing is said
    std::optional<HalfMotions> halves;  ///< of a chimeric clip
};

/// When the strongest expression of a script is told to begin and to be complete.
void find_commanded(const track::ScriptDescription& script, double lead_s, ShownClip& shown) {
    const track::ExpressionEvent* strongest = nullptr;
    for (const track::ExpressionEvent& event : script.expressions) {
        if (!strongest || event.intensity > strongest->intensity) strongest = &event;
        shown.commanded_onset_s =
            std::min(shown.commanded_onset_s.value_or(INFINITY), lead_s + event.start_s);
    }
    if (strongest) shown.commanded_apex_s = lead_s + strongest->start_s + strongest->onset_s;
}

/// SeenMotion::full_mm of a clip.
std::optional<double> full_motion_mm(const ClipPlan& plan, const ClipWorker& worker) {
    // Random movements have no full intensity.
    if (!plan.condition.units.empty()) return {};
    const std::optional<Json> script = expression_at_full_intensity(plan.condition.script);
    if (!script) return {};
    ClipPlan full = plan;
    full.condition.script = *script;
    const std::string key = json_text(*script) + plan.condition.folder.string();
    return worker.settled.at(key, [&] {
        return settled_way_mm(render_job_of(full, worker.folder / "none.mkv", {}, worker),
                              worker.session);
    });
}

/// The frames of a film that a clip shows whose control changes the speed.
std::vector<int> retimed(const ClipPlan& plan, const SeenMotion& film, int frames) {
    std::vector<double> way = film.way_mm;
    way.resize(static_cast<std::size_t>(frames));
    const int onset = film.onset.value_or(0), apex = film.apex.value_or(0);
    return design::retimed_order(plan.condition.control.speed, way, onset, apex, plan.finer(),
                                 plan.frames - plan.lead_frames);
}

/// The rows of the clip, and its pictures to `pictures`: rendered, or taken from an unmatched render.
void show_pictures(const animate::RenderJob& job, const std::optional<UnmatchedRender>& unmatched,
                   const ClipWorker& worker, ClipPictures& pictures, ShownClip& shown) {
    if (unmatched) {
        shown.run = unmatched->run;
        shown.rows = animate::frame_rows(unmatched->table);
        pictures.know(shown.rows);
        show_matched(*unmatched, worker.monitor, pictures);
        return;
    }
    const animate::RenderResult result = animate::run_render_job(
        job, worker.session, [&](Image image) { pictures.add(std::move(image)); }, worker.monitor);
    shown.run = portable_record(result.record);
    shown.rows = animate::frame_rows(result.table);
}

/// What is seen to move in a video, and the order of its frames.
void find_motion(const ClipPlan& plan, const animate::RenderJob& job, const ClipWorker& worker,
                 ShownClip& shown) {
    std::optional<animate::LandmarkFrames> twin;
    if (const auto without = animate::job_without_expression(job))
        twin = animate::play_landmarks(*without, worker.session, worker.monitor);
    const design::Control& control = plan.condition.control;
    SeenMotion forwards;
    if (control.kind == ControlKind::kApex || control.kind == ControlKind::kSpeed) {
        std::vector<int> all(static_cast<std::size_t>(job.frames));
        std::iota(all.begin(), all.end(), 0);
        forwards = seen_motion(shown.rows, twin, all, plan.fps);
    }
    shown.order = control.kind == ControlKind::kSpeed
                      ? retimed(plan, forwards, job.frames)
                      : design::frame_order(control, job.frames, forwards.apex.value_or(0),
                                            plan.condition.seed);
    shown.order.insert(shown.order.begin(), static_cast<std::size_t>(plan.lead_frames),
                       shown.order.front());
    // A mask shows no face, and a chimera two.
    if (control.kind != ControlKind::kMondrian && !plan.lower)
        shown.motion = seen_motion(shown.rows, twin, shown.order, plan.fps);
}

/// Renders the clip, or takes its pictures from an unmatched render, and applies the control. `picture`: in a set of pictures.
ShownClip show_clip(const ClipPlan& plan, const animate::RenderJob& job,
                    const std::optional<UnmatchedRender>& unmatched,
                    const std::optional<SeenPicture>& picture, const ClipWorker& worker,
                    ClipPictures& pictures) {
    ShownClip shown;
    show_pictures(job, unmatched, worker, pictures, shown);
    const ControlKind kind = plan.condition.control.kind;
    const animate::FrameRows upper = shown.rows;  // what pictures are measured by
    std::optional<Chimera> chimera;
    LowerHalf lower;
    if (plan.lower) {
        lower = lower_half(plan, worker);
        chimera.emplace(plan, upper, std::move(lower.frames));
        pictures.combine_with(*chimera);
        shown.rows = chimera->rows(upper, lower.rows);
    }
    if (!picture) {
        find_motion(plan, job, worker, shown);
    } else {
        shown.order = {0};
        shown.first_source = picture->frame;
        if (!picture->landmark.empty() && kind != ControlKind::kMondrian && !chimera) {
            shown.motion.seen_mm = picture->seen_mm;
            shown.motion.landmark = picture->landmark;
        }
    }
    if (chimera) {
        shown.halves = picture
                           ? half_motions(plan, picture->frame, upper, lower, *chimera, worker)
                           : half_motions(plan, job, upper, lower, *chimera, shown.order, worker);
        shown.motion =
            seen_together(shown.halves->upper, shown.halves->lower, shown.order, plan.fps);
    }
    if (kind == ControlKind::kMirrored) shown.motion.landmark = other_side(shown.motion.landmark);
    if (shown.motion.seen_mm && !chimera) shown.motion.full_mm = full_motion_mm(plan, worker);
    if (!picture && !chimera && std::is_sorted(shown.order.begin(), shown.order.end()) &&
        shown.motion.seen_mm)
        find_commanded(job.script, static_cast<double>(plan.lead_frames) / plan.fps, shown);
    if (!picture && std::is_sorted(shown.order.begin(), shown.order.end()))
        shown.speech = speech_moments(job, upper);
    pictures.know(upper);
    pictures.finish(shown.order);
    if (chimera) shown.seam = chimera->json();
    if (unmatched) shown.luminance = matched_luminance(plan, *unmatched, pictures);
    return shown;
}

/// The sidecar without the checksums of the files.
Json sidecar_of(const ClipPlan& plan, ShownClip shown, ClipPictures& pictures) {
    const auto or_null = [](const auto& value) { return value ? Json(*value) : Json(); };
    Json motion = json_of(shown.motion, pictures.pixel_onset());
    motion["commanded_onset_s"] = or_null(shown.commanded_onset_s);
    motion["commanded_apex_s"] = or_null(shown.commanded_apex_s);
    if (shown.halves) {
        motion["upper"] = json_of_half(shown.halves->upper);
        motion["lower"] = json_of_half(shown.halves->lower);
    }
    Json record = json_object({{"format", "risorius-clip"},
                               {"version", 1},
                               {"stim_id", plan.condition.clip},
                               {"design", plan.design},
                               {"set", plan.condition.set},
                               {"control", plan.condition.control.name()},
                               {"of", plan.condition.of},
                               {"values", Json::object()},
                               {"frames", plan.frames},
                               {"fps", plan.fps},
                               {"duration_s", plan.duration_s()},
                               {"movement_onset_frame", or_null(shown.motion.onset)},
                               {"apex_frame", or_null(shown.motion.apex)},
                               {"motion", std::move(motion)},
                               {"pictures_sha256", pictures.sha256()},
                               {"content_sha256", plan.content_sha256},
                               {"files", Json::object()},
                               {"run", std::move(shown.run)}});
    for (const auto& [name, value] : plan.condition.values) record["values"][name] = value;
    if (plan.sound)
        record["audio"] =
            json_object({{"file", fs::path(plan.sound->name).filename().generic_string()},
                         {"sha256", plan.sound->sha256},
                         {"offset_samples", plan.sound->offset_samples},
                         {"gain_db", plan.sound->gain_db},
                         {"onset_s", or_null(plan.sound->onset_s)},
                         {"loudness_lufs", finite_or_null(plan.sound->loudness.integrated_lufs)},
                         {"true_peak_dbtp", finite_or_null(plan.sound->loudness.true_peak_dbtp)}});
    if (!shown.speech.is_null()) record["speech"] = std::move(shown.speech);
    if (!shown.seam.is_null()) record["seam"] = std::move(shown.seam);
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
    write_file(written[files.script], clip_script(plan, plan.condition.script, folder));
    if (plan.lower)
        write_file(written[files.lower_script],
                   clip_script(plan, plan.lower->condition.script, folder));

    const fs::path video_file = written[files.video];
    media::VideoOptions coding;
    coding.crf = plan.clips.crf;
    coding.lossless = plan.clips.lossless;
    coding.keyframe_interval = keyframe_interval(plan);
    coding.still = shows_one_picture(plan.condition.control.kind) && !plan.clips.photodiode;
    std::optional<SeenPicture> picture;
    if (plan.clips.pictures())
        picture = unmatched ? unmatched->picture : picture_frame(plan, worker);
    animate::RenderJob job =
        render_job_of(plan, plan.clips.pictures() ? folder / "none.mkv" : video_file, coding,
                      worker, picture ? std::optional<int>(picture->frame) : std::nullopt);
    job.video.fps = plan.fps;
    if (ClipPictures::has_layers(plan)) job.view.background.transparent = true;
    if (plan.sound) {
        job.video.sound = sound_of(*plan.sound);
        job.video.sound_offset_samples = plan.sound->offset_samples;
    }
    std::optional<media::VideoWriter> video;
    if (!picture) video.emplace(video_file, job.video);
    ClipPictures pictures(plan, [&](const Image& image) {
        if (video)
            video->append(image);
        else
            media::write_png(image, video_file);
    });
    ShownClip shown = show_clip(plan, job, unmatched, picture, worker, pictures);

    // All files appear together, or none.
    if (video) video->finish();
    const std::string table =
        events_table(shown.rows, shown.order, shown.first_source, pictures.measures(), plan);
    write_file(written[files.events], table);
    write_file(written[files.columns], frame_columns(table, plan));
    media::write_png(pictures.strip(), written[files.strip]);
    if (plan.has_aois()) {
        const AoiFiles aois = aoi_files(shown.rows, shown.order, plan);
        write_file(written[files.aois], aois.table);
        write_file(written[files.aoi_columns], aois.columns);
        write_file(written[files.aoi_key_frames], aois.key_frames);
        write_file(written[files.aoi_ias], aois.ias);
    }
    if (plan.sound)
        media::write_wav(heard_of(*plan.sound, static_cast<double>(plan.frames) / plan.fps),
                         written[files.sound]);
    Json record = sidecar_of(plan, std::move(shown), pictures);
    for (const fs::path& file : files.listed())
        record["files"][file.generic_string()] = sha256_of_file(written[file]);
    write_file(sidecar, json_text(record, 2) + "\n");
    worker.monitor.throw_if_stopped();
    outputs.commit();
    if (unmatched && !plan.render_is_shared && !plan.mapped) remove_unmatched_render(plan, folder);
}

}  // namespace risorius::stimuli
