#include "risorius/stimuli/detail/clip.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "risorius/animate/film.h"
#include "risorius/animate/frame_rows.h"
#include "risorius/core/error.h"
#include "risorius/core/version.h"
#include "risorius/media/image_file.h"
#include "risorius/media/sha256.h"
#include "risorius/media/sync_marks.h"
#include "risorius/media/video_reader.h"
#include "risorius/media/wav_file.h"
#include "risorius/report/atomic_file.h"
#include "risorius/stimuli/detail/clip_pictures.h"
#include "risorius/stimuli/detail/take.h"
#include "risorius/track/timeline.h"

namespace risorius::stimuli {

namespace fs = std::filesystem;
using design::ControlKind;

namespace {

// About, on two cores: seconds for a clip, a frame and for its pixels, and bytes for a pixel
constexpr double kClip_s = 0.1, kFrame_s = 0.04, kPixel_s = 1e-7, kByte_px = 0.03,
                 kLosslessByte_px = 1.2;
constexpr double kMostHeld_bytes = 0.6e9;  // of frames that are shown in another order

std::string sha256_of(const std::string& text) {
    media::Sha256 hash;
    hash.add(text.data(), text.size());
    return hash.finish();
}

/// The script's files, as keys in it: where each stands, relative to `folder` or not.
std::vector<Json::json_pointer> file_keys(const Json& script) {
    std::vector<Json::json_pointer> out;
    for (const char* key : {"/rig", "/emg/file", "/view/light/file"})
        if (const Json::json_pointer at(key); script.contains(at) && script.at(at).is_string())
            out.push_back(at);
    return out;
}

/// The same script for a file in another folder.
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

/// As BIDS names what can be seen, and seen and heard.
std::string suffix(const ClipPlan& plan) { return plan.sound ? "_audiovideo" : "_video"; }

/// Whether the table tells where the landmarks are, by wish or because the clip is made with it.
bool films_landmarks(const ClipPlan& plan) {
    const design::ControlKind kind = plan.condition.control.kind;
    return plan.clips.landmarks || shows_part(kind) || kind == design::ControlKind::kApex ||
           (plan.luminance && plan.luminance->within_face);
}

/// In any frame.
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

Json finite_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(); }

/// The pictures of a take, matched, and how light they were and are.
Json show_take(const ClipPlan& plan, const Take& take, const animate::FrameRows& rows,
               const ProgressMonitor& monitor, ClipPictures& pictures) {
    const media::Tone tone = plan.tone.value_or(media::Tone{});
    const media::ToneCurve curve(tone);
    media::VideoReader reader(take.video);
    media::LuminanceSums after;
    double cut_off = 0;
    for (int frame = 0; frame < reader.frames(); ++frame) {
        monitor.report(static_cast<double>(frame) / reader.frames(), animate::kRendering);
        Image image = reader.frame(frame);
        const std::vector<std::uint16_t> part = measured_part(plan, rows, frame);
        cut_off += curve.cut_off(image, part) / reader.frames();
        Image matched = image;
        curve.apply(matched);
        after.add(matched, part);
        pictures.take(std::move(image));
    }
    return {{"film_sha256", plan.film_sha256},
            {"within", plan.luminance->within_face ? "face" : "picture"},
            {"gain", tone.gain},
            {"offset", tone.offset},
            {"before", json_of(take.luminance)},
            {"after", json_of(after)},
            {"cut_off", cut_off}};
}

}  // namespace

Json run_without_places(const animate::RunRecord& record) {
    Json json = record.json();
    for (const char* key : {"out", "timing", "script"}) json.erase(key);
    const auto name_only = [](Json& file) {
        file["file"] = fs::path(file.at("file").get<std::string>()).filename().generic_string();
    };
    for (const char* key : {"rig", "mesh"}) name_only(json[key]);
    for (const char* key : {"tables", "recordings"})
        for (Json& file : json[key]) name_only(file);
    return json;
}

std::string text_of_file(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
}

double ClipPlan::seconds() const {
    return kClip_s + frames * (kFrame_s + kPixel_s * width_px * height_px);
}
double ClipPlan::megabytes() const {
    const double take = luminance ? kLosslessByte_px : 0;
    return 1e-6 * frames *
           (take + (clips.lossless || clips.ending == "mkv" ? kLosslessByte_px : kByte_px)) *
           width_px * height_px;
}

void ClipPlan::match(const media::Tone& matched) {
    tone = matched;
    const media::ToneCurve curve(matched);
    for (std::uint8_t& byte : background) byte = curve.of(byte);
    content_sha256 = sha256_of(
        Json{{"content", content_sha256}, {"gain", tone->gain}, {"offset", tone->offset}}.dump());
}

const RigDigests::Known& RigDigests::at(const fs::path& rig) {
    const fs::path key = fs::weakly_canonical(rig);
    const auto found = known_.find(key);
    if (found != known_.end()) return found->second;
    scene::RigFiles files = scene::read_rig_files(rig);
    std::string digests =
        media::sha256_of_file(files.file) + media::sha256_of_file(files.rig.mesh_file);
    for (const fs::path& table : files.rig.table_files) digests += media::sha256_of_file(table);
    return known_.emplace(key, Known{std::move(files), sha256_of(digests)}).first->second;
}

ClipPlan plan_clip(const design::Condition& condition, const design::Design& design,
                   RigDigests& rigs, SoundPlans& sounds) {
    const design::ClipOptions& clips = design.clips;
    ClipPlan plan;
    plan.condition = condition;
    plan.clips = clips;
    plan.luminance = design.match.luminance;
    // As if it were a file beside the template, so that messages and relative paths are right
    const std::string told_by = condition.folder == design.file.parent_path()
                                    ? design.file.filename().string()
                                    : "script of " + design.file.filename().string();
    const JsonCursor json = JsonCursor::from_json(
        condition.script, (condition.folder / (told_by + ", clip " + condition.clip)).string());
    const track::ScriptHeader header = track::read_script_header(json);
    const RigDigests::Known& rig = rigs.at(header.rig_file);
    const track::ScriptDescription script = track::read_script(
        json, rig.files.rig.channels(), rig.files.rig.facs, rig.files.rig.expressions);
    plan.frames = header.frame_count();
    plan.fps = header.fps;
    plan.width_px = header.view.width_px;
    plan.height_px = header.view.height_px;
    for (std::size_t k = 0; k < 3; ++k)
        plan.background[k] =
            static_cast<std::uint8_t>(std::lround(255 * header.view.background_rgb[k]));
    const design::ControlKind kind = condition.control.kind;
    if ((shows_other_order(kind) || shows_part(kind)) &&
        4.0 * plan.frames * plan.width_px * plan.height_px > kMostHeld_bytes)
        throw Error(json.place(),
                    "fewer or smaller frames for the control " + condition.control.name() +
                        ", which keeps them in memory",
                    std::to_string(plan.frames) + " of " + std::to_string(plan.width_px) + " x " +
                        std::to_string(plan.height_px));
    if (kind == design::ControlKind::kFlipped &&
        moves_the_head(script, rig.files.rig.channels(), plan))
        throw Error(json.place(), "a head that keeps still, for the control flipped",
                    "one that the script moves");
    if (clips.photodiode) media::corner_named(*clips.photodiode, "clips/photodiode");

    if (condition.audio)
        plan.sound = sounds.at(condition, static_cast<double>(plan.frames) / plan.fps,
                               design.match.loudness_lufs, json.place());

    plan.scene_sha256 =
        sha256_of(Json{rig.sha256, clips.quality, condition.script.value("view", Json())}.dump());

    // All that its pictures hang on
    Json film{{"toolkit", kVersion},
              {"compiler", __VERSION__},
              {"script", condition.script},
              {"rig", rig.sha256},
              {"quality", clips.quality},
              {"landmarks", films_landmarks(plan)},
              {"flipped", kind == design::ControlKind::kFlipped},
              {"within", plan.luminance && plan.luminance->within_face ? "face" : "picture"}};
    for (const Json::json_pointer& key : file_keys(condition.script)) {
        film["script"][key] = "";
        const fs::path file = condition.script.at(key).get<std::string>();
        if (key.to_string() != "/rig")
            film["files"].push_back(
                media::sha256_of_file(file.is_relative() ? condition.folder / file : file));
    }
    plan.film_sha256 = sha256_of(film.dump());

    // And the clip
    Json content{{"film", plan.film_sha256},
                 {"control", condition.control.name()},
                 {"seed", kind == design::ControlKind::kScrambled ||
                                  kind == design::ControlKind::kPhaseScrambled
                              ? condition.seed
                              : 0u},
                 {"ending", clips.ending},
                 {"crf", clips.crf ? Json(*clips.crf) : Json()},
                 {"lossless", clips.lossless},
                 {"landmarks", clips.landmarks},
                 {"photodiode", clips.photodiode ? Json(*clips.photodiode) : Json()}};
    if (plan.sound)
        content["sound"] = {{"file", plan.sound->sha256},
                            {"offset_samples", plan.sound->offset_samples},
                            {"gain_db", plan.sound->gain_db}};
    plan.content_sha256 = sha256_of(content.dump());
    return plan;
}

std::vector<fs::path> ClipFiles::told() const {
    std::vector<fs::path> files{script, strip, video, events};
    if (!sound.empty()) files.push_back(sound);
    return files;
}

ClipFiles clip_files(const ClipPlan& plan) {
    return {script_file(plan),
            fs::path("overview") / (plan.condition.clip + ".png"),
            stem(plan) + suffix(plan) + "." + plan.clips.ending,
            stem(plan) + "_annot-frames_events.tsv",
            plan.sound ? fs::path(stem(plan) + "_audio.wav") : fs::path(),
            stem(plan) + suffix(plan) + ".json"};
}

Json clip_record(const ClipPlan& plan, const fs::path& folder) {
    return JsonCursor::read_file(folder / clip_files(plan).sidecar).json();
}

bool is_made(const ClipPlan& plan, const fs::path& folder) {
    const ClipFiles files = clip_files(plan);
    if (!fs::exists(folder / files.sidecar)) return false;
    try {
        const Json record = clip_record(plan, folder);
        if (record.value("content_sha256", "") != plan.content_sha256) return false;
        for (const fs::path& file : files.told())
            if (!fs::exists(folder / file) || record.at("files").value(file.generic_string(), "") !=
                                                  media::sha256_of_file(folder / file))
                return false;
        return true;
    } catch (const std::exception&) {
        return false;  // something else, or half of it: made again
    }
}

void write_clip_script(const ClipPlan& plan, const fs::path& folder) {
    const fs::path script = folder / script_file(plan);
    fs::create_directories(script.parent_path());
    report::write_text(
        script,
        relocated(plan.condition.script, plan.condition.folder, script.parent_path()).dump(2) +
            "\n");
}

animate::AnimateOptions film_options(const ClipPlan& plan, const fs::path& folder,
                                     const fs::path& out, const CoreShare& share) {
    animate::AnimateOptions options;
    options.script = folder / script_file(plan);
    options.out = out;
    options.quality = plan.clips.quality;
    options.landmarks = films_landmarks(plan);
    options.threads = share.threads;
    options.films_at_once = share.clips_at_once;
    options.flipped_motion = plan.condition.control.kind == design::ControlKind::kFlipped;
    return options;
}

void make_clip(const ClipPlan& plan, const fs::path& folder, const CoreShare& share,
               const ProgressMonitor& monitor, animate::Studio& studio) {
    const ClipFiles files = clip_files(plan);
    for (const fs::path& file : {files.strip, files.video})
        fs::create_directories((folder / file).parent_path());
    std::optional<Take> take;
    if (plan.luminance) {
        take = find_take(plan, folder);
        if (!take) {
            make_take(plan, folder, share, monitor, studio);
            take = find_take(plan, folder);
            if (!take) throw RunError(plan.condition.clip + ": its take has gone");
        }
    }
    // Not complete from here on
    fs::remove(folder / files.sidecar);
    write_clip_script(plan, folder);

    const fs::path video_file = folder / files.video;
    animate::AnimateOptions options = film_options(plan, folder, video_file, share);
    options.video.crf = plan.clips.crf;
    options.video.lossless = plan.clips.lossless;
    animate::Shot shot = animate::plan_shot(options);
    if (plan.sound) {
        shot.video.sound = sound_of(*plan.sound);
        shot.video.sound_offset_samples = plan.sound->offset_samples;
    }
    media::VideoWriter video(video_file, shot.video);
    ClipPictures pictures(plan, video);
    animate::FrameRows rows;
    Json run, luminance;
    if (take) {
        run = take->run;
        rows = animate::frame_rows(take->table);
        luminance = show_take(plan, *take, rows, monitor, pictures);
    } else {
        animate::FilmExtras extras;
        run = run_without_places(animate::film(
            options, shot, [&](Image image) { pictures.take(std::move(image)); }, extras, monitor,
            studio));
        rows = animate::frame_rows(extras.table);
    }
    const animate::Moments moments = animate::moments_of(animate::landmark_ways(rows));
    const std::vector<int> order =
        design::frame_order(plan.condition.control, shot.frames, moments.apex, plan.condition.seed);
    pictures.finish(rows, order);

    // Each whole or not at all, the sidecar last
    video.finish();
    report::write_text(folder / files.events, events_table(rows, order, pictures.measures(), plan));
    media::write_png(pictures.strip(), folder / files.strip);
    if (plan.sound)
        media::write_wav(heard_of(*plan.sound, static_cast<double>(shot.frames) / plan.fps),
                         folder / files.sound);
    const auto shown_at = [&](int frame) {
        return static_cast<int>(std::find(order.begin(), order.end(), frame) - order.begin());
    };
    Json record{{"format", "risorius-clip"},
                {"version", 1},
                {"stim_id", plan.condition.clip},
                {"set", plan.condition.set},
                {"control", plan.condition.control.name()},
                {"of", plan.condition.of},
                {"values", Json::object()},
                {"frames", shot.frames},
                {"fps", plan.fps},
                {"duration_s", static_cast<double>(shot.frames) / plan.fps},
                {"movement_onset_frame", shown_at(moments.onset)},
                {"apex_frame", shown_at(moments.apex)},
                {"pictures_sha256", pictures.sha256()},
                {"content_sha256", plan.content_sha256},
                {"files", Json::object()},
                {"run", std::move(run)}};
    for (const auto& [name, value] : plan.condition.values) record["values"][name] = value;
    if (plan.sound)
        record["audio"] = {{"file", plan.sound->file.filename().generic_string()},
                           {"sha256", plan.sound->sha256},
                           {"offset_samples", plan.sound->offset_samples},
                           {"gain_db", plan.sound->gain_db},
                           {"loudness_lufs", finite_or_null(plan.sound->loudness.integrated_lufs)},
                           {"true_peak_dbtp", finite_or_null(plan.sound->loudness.true_peak_dbtp)}};
    if (take) record["luminance"] = std::move(luminance);
    for (const fs::path& file : files.told())
        record["files"][file.generic_string()] = media::sha256_of_file(folder / file);
    report::write_text(folder / files.sidecar, record.dump(2) + "\n");
    if (take && !plan.take_is_shared) remove_take(plan, folder);
}

}  // namespace risorius::stimuli
