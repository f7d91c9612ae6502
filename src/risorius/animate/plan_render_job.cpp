// SPDX-License-Identifier: MIT
// Plans a render: reads every input once, and checks it and the request.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "risorius/animate/detail/pass_writer.h"
#include "risorius/animate/detail/read_checksums.h"
#include "risorius/animate/render_job.h"
#include "risorius/core/error.h"
#include "risorius/core/existing_file.h"
#include "risorius/core/json_text.h"
#include "risorius/core/known_names.h"
#include "risorius/core/sha256.h"
#include "risorius/face/quality.h"
#include "risorius/media/hdr_file.h"
#include "risorius/media/sync_marks.h"
#include "risorius/report/output_paths.h"
#include "risorius/report/stopwatch.h"
#include "risorius/rig/head.h"
#include "risorius/rig/rig_description.h"
#include "risorius/talk/say_event.h"

namespace risorius::animate {

namespace fs = std::filesystem;

std::string RenderJob::background_text() const {
    const render::Background& background = view.background;
    if (background.transparent) return "transparent";
    char text[8];
    const auto byte = [&](int k) {
        return static_cast<unsigned>(
            std::lround(255 * background.rgb[static_cast<std::size_t>(k)]));
    };
    std::snprintf(text, sizeof text, "#%02x%02x%02x", byte(0) & 255, byte(1) & 255, byte(2) & 255);
    return text;
}

namespace {

media::VideoOptions video_options(const RenderRequest& request, const RenderJob& job) {
    media::VideoOptions video = request.video;
    video.width_px = job.view.width_px;
    video.height_px = job.view.height_px;
    video.fps = job.fps;
    video.alpha = job.view.background.transparent;
    const bool is_h264 =
        request.out.extension() == ".mp4" || (request.out.extension() == ".mov" && !video.alpha);
    if (request.draft && is_h264 && !video.preset) video.preset = "ultrafast";
    if (!request.sound && request.audio)
        throw Error(option_name("audio"), "a video with sound", "one without");
    if (request.audio_offset && !request.audio)
        throw Error(option_name("audio_offset"), "a recording, by " + option_name("audio"), "none");
    if (!request.audio) return video;
    video.sound = std::make_shared<media::Recording>(media::open_recording(*request.audio));
    video.sound_offset_samples = request.audio_offset.value_or(0);
    const double at_s = static_cast<double>(video.sound_offset_samples) / video.sound->rate_hz;
    const double length_s = static_cast<double>(video.sound->length()) / video.sound->rate_hz;
    if (at_s >= job.script.header.duration_s || at_s + length_s <= 0)
        throw Error(
            option_name("audio_offset"),
            "an offset with which the video contains some of the recording",
            std::to_string(video.sound_offset_samples) + " samples, " + format_number(at_s) + " s");
    return video;
}

std::string times_of(const RenderJob& job) {
    return "a time in [0, " + format_number(job.script.header.duration_s) + "]";
}

/// A still has no sound and needs no encoder.
void check_still(const RenderRequest& request) {
    const media::VideoOptions& video = request.video;
    for (const auto& [given, name] :
         {std::pair{request.audio.has_value(), option_name("audio")},
          std::pair{video.crf.has_value(), option_name("crf")},
          std::pair{video.preset.has_value(), option_name("preset")},
          std::pair{video.pixels.has_value(), option_name("pixels")},
          std::pair{video.keyframe_interval.has_value(), option_name("keyframe_interval")},
          std::pair{video.lossless, option_name("lossless")}})
        if (given) throw Error(name, "a video to encode", option_name("still_s"));
}

void check_marks(const SyncMarks& marks, const RenderJob& job) {
    const int smaller = std::min(job.view.width_px, job.view.height_px);
    if (marks.photodiode) {
        media::corner_named(*marks.photodiode, option_name("photodiode"));
        index_of_name(option_name("photodiode_shows"), marks.photodiode_shows,
                      {"frames", "events"});
        if (marks.photodiode_px < 2 || marks.photodiode_px > smaller / 2)
            throw Error(option_name("photodiode_size"),
                        "pixels in [2, " + std::to_string(smaller / 2) +
                            "], half the smaller side of the picture",
                        std::to_string(marks.photodiode_px));
    }
    if (!marks.frame_counter) return;
    media::corner_named(*marks.frame_counter, option_name("frame_counter"));
    const int largest = job.view.width_px / media::kCounterCells;
    if (marks.frame_counter_px < 2 || marks.frame_counter_px > largest)
        throw Error(option_name("frame_counter_size"),
                    "pixels in [2, " + std::to_string(largest) + "], " +
                        std::to_string(media::kCounterCells) + " cells side by side",
                    std::to_string(marks.frame_counter_px));
    const auto is_upper = [](const std::string& corner) { return corner.starts_with("upper"); };
    if (marks.photodiode &&
        (marks.photodiode == marks.frame_counter ||
         (is_upper(*marks.photodiode) == is_upper(*marks.frame_counter) &&
          media::kCounterCells * marks.frame_counter_px + marks.photodiode_px > job.view.width_px)))
        throw Error(option_name("frame_counter"),
                    "a place that the photodiode's square leaves free",
                    "\"" + *marks.frame_counter + "\"");
}

/// Frames per second and their number, from the script or the request.
void plan_rate(const RenderRequest& request, RenderJob& job) {
    const track::ScriptHeader& header = job.script.header;
    job.fps = header.fps;
    if (request.fps) {
        if (*request.fps < 1 || *request.fps > 240)
            throw Error(option_name("fps"), "an integer in [1, 240]", std::to_string(*request.fps));
        job.fps = *request.fps;
    }
    job.frames = track::frame_count(header.duration_s, job.fps);
    if (job.frames < 1)
        throw Error(option_name("fps"),
                    "at least one frame in " + format_number(header.duration_s) + " s",
                    std::to_string(job.fps));
}

render::LightOptions light_of(const track::ScriptLight& asked) {
    render::LightOptions light;
    light.preset = asked.preset;
    light.turn_deg = asked.turn_deg;
    light.exposure_ev = asked.exposure_ev;
    light.meter = asked.for_card ? render::Meter::kCard : render::Meter::kSkin;
    if (asked.file.empty()) return light;
    media::HdrPicture map = media::read_hdr(asked.file);
    if (map.width != 2 * map.height)
        throw Error(asked.file.string(), "a map twice as wide as high",
                    std::to_string(map.width) + "x" + std::to_string(map.height));
    light.surroundings = render::Surroundings{map.width, map.height, std::move(map.rgb)};
    return light;
}

void plan_view(const RenderRequest& request, RenderJob& job) {
    const track::ScriptView& asked = job.script.header.view;
    render::ViewOptions& view = job.view;
    view.width_px = request.size ? request.size->width_px : asked.width_px;
    view.height_px = request.size ? request.size->height_px : asked.height_px;
    view.camera = request.camera.value_or(asked.camera);
    view.show = render::show_named(request.show.value_or(asked.show), option_name("show"));
    view.background = {.transparent = asked.transparent, .rgb = asked.background_rgb};
    view.lens = {.orthographic = asked.orthographic,
                 .distance_m = asked.distance_m,
                 .view_angle_deg = asked.view_angle_deg,
                 .aperture_mm = asked.aperture_mm};
    view.draft = request.draft;
    static const std::vector<std::string> kHair{"none", "own"};
    view.hair =
        request.hair ? index_of_name(option_name("hair"), *request.hair, kHair) == 1 : asked.hair;
    view.supersampling = request.antialiasing.value_or(request.draft ? 1 : asked.antialiasing);
    if (view.supersampling < 1 || view.supersampling > 4)
        throw Error(option_name("antialiasing"), "samples per pixel and side in [1, 4]",
                    std::to_string(view.supersampling));
    job.shutter_deg = request.shutter_deg.value_or(asked.shutter_deg);
    if (!(job.shutter_deg >= 0 && job.shutter_deg <= 360))
        throw Error(option_name("shutter_deg"), "degrees in [0, 360]",
                    format_number(job.shutter_deg));
    view.light = light_of(asked.light);
    // All renders of the process share the threads of the driver.
    const int drawing = request.threads * request.renders_at_once;
    view.threads = drawing > 1 ? drawing : 0;
    index_of_name(option_name("camera"), view.camera, render::camera_names());
    for (int side : {view.width_px, view.height_px})
        if (side < 16 || side > 8192)
            throw Error(option_name("size"), "a width and a height in [16, 8192]",
                        std::to_string(side));
}

/// The request and the script must provide what the picture shows.
void check_show(const RenderRequest& request, const RenderJob& job) {
    const std::string shown = request.show.value_or(job.script.header.view.show);
    const bool compared = job.view.show == render::Show::kError;
    if (compared != request.against.has_value())
        throw compared
            ? Error(option_name("show") + " error",
                    "a script to compare with, by " + option_name("against"), "none")
            : Error(option_name("against"), option_name("show") + " error, which compares",
                    option_name("show") + " " + shown);
    if (request.scale) {
        if (!compared && job.view.show != render::Show::kStrain)
            throw Error(option_name("scale"),
                        option_name("show") + " strain or error, which have one",
                        option_name("show") + " " + shown);
        if (!(*request.scale > 0 && *request.scale <= 1000))
            throw Error(option_name("scale"), "a number in (0, 1000]",
                        format_number(*request.scale));
    }
    if (!request.shapes) return;
    if (job.view.show == render::Show::kMuscles)
        throw Error(option_name("shapes"), "a view of the skin, as blend shapes move no muscles",
                    option_name("show") + " muscles");
    if (job.script.header.jaw == track::JawDrive::kMuscles)
        throw Error(
            request.script.string() + ":/jaw",
            "\"channels\" with " + option_name("shapes") + ", which open the jaw as channels say",
            "\"muscles\"");
}

void plan_passes(const RenderRequest& request, RenderJob& job) {
    for (const std::string& pass : request.passes) {
        index_of_name(option_name("passes"), pass, pass_names());
        if (pass == "flow" && request.still_s)
            throw Error(option_name("passes"), "passes of one frame with " + option_name("still_s"),
                        "\"flow\", to the next one");
    }
    job.passes = request.passes;
    job.passes_folder = report::output_path(request.out, ".passes");
}

/// The times of the frames: those of the script, given times, a turntable or a still.
void plan_times(const RenderRequest& request, RenderJob& job) {
    const auto checked = [&](double time_s, const char* option) {
        if (!(time_s >= 0 && time_s <= job.script.header.duration_s))
            throw Error(option_name(option), times_of(job), format_number(time_s));
        return time_s;
    };
    if (!request.times_s.empty()) {
        for (const double time_s : request.times_s)
            job.times_s.push_back(checked(time_s, "times_s"));
        job.frames = static_cast<int>(job.times_s.size());
        job.first_frame_s = job.times_s.front();
        return;
    }
    if (request.turntable_s) {
        if (request.still_s)
            throw Error(option_name("turntable_s"), "no " + option_name("still_s") + " beside it",
                        "both");
        job.first_frame_s = checked(*request.turntable_s, "turntable_s");
        job.turntable = true;
    }
    if (!request.still_s) {
        media::check_target(request.out, job.video);
        return;
    }
    check_still(request);
    job.first_frame_s = checked(*request.still_s, "still_s");
    if (request.out.extension() != ".png")
        throw Error(request.out.string(), "an ending of .png for a still",
                    "\"" + request.out.extension().string() + "\"");
    job.frames = 1;
    job.still = true;
}

/// The sound of what is said, unless the request has another.
void add_spoken_sound(const RenderRequest& request, RenderJob& job) {
    if (!request.sound || request.audio || job.still || job.speech.sound_file.empty()) return;
    if (request.out.filename().empty()) {
        job.warnings.push_back("a folder of frames has no sound; what is said is in " +
                               job.speech.sound_file.string());
        return;
    }
    job.video.sound =
        std::make_shared<media::Recording>(media::open_recording(job.speech.sound_file));
    job.video.sound_offset_samples = job.speech.sound_offset_samples;
}

/// Pulls need vertices of the mesh, and a face that is simulated.
void check_pulls(const RenderRequest& request, const JsonCursor& script, const RenderJob& job) {
    const int vertices = job.rig->files.mesh.vertex_count();
    for (std::size_t i = 0; i < job.script.pulls.size(); ++i) {
        const JsonCursor pull = script.at("pulls").items()[i];
        if (request.shapes)
            pull.fail("no pull with " + option_name("shapes") + ", as blend shapes are not soft",
                      "one");
        if (job.script.pulls[i].vertex >= vertices)
            pull.at("vertex").fail("a vertex of the mesh, [0, " + std::to_string(vertices - 1) +
                                   "]");
    }
}

/// The script as read, from memory or from its file.
ScriptInput script_input(const RenderRequest& request, RenderInputs& inputs) {
    if (request.script_in_memory)
        return {*request.script_in_memory,
                sha256_of_text(json_text(request.script_in_memory->json()))};
    return *inputs.script(request.script);
}

/// The blend shapes, checked against the vertices of the rig's mesh.
ShapesInput shapes_input(const fs::path& file, const scene::RigFiles& files) {
    const rig::Head head = rig::place_head(files.rig, files.mesh, files.place());
    ReadChecksums sums;
    auto content = std::make_shared<const blendshapes::ShapesOfFile>(
        blendshapes::read_shapes_of_file(file, files, head));
    return {sums.of(file), std::move(content)};
}

/// Reads the rig, and checks the script and the script to compare with against it.
void plan_rig_and_script(const RenderRequest& request, const JsonCursor& script,
                         RenderInputs& inputs, RenderJob& job) {
    job.rig = inputs.rig(request.rig.value_or(job.script.header.rig_file));
    const rig::RigDescription& rig = job.rig->files.rig;
    const track::ChannelTable channels = rig.channels();
    {
        ReadChecksums sums;
        job.script = track::read_script(script, channels, rig.facs, rig.expressions);
        for (const fs::path& recording : job.script.recordings)
            job.recordings.push_back(sums.of(recording));
    }
    job.speech =
        talk::plan_speech(job.script.says, job.script.header, job.rig->files, inputs.mouth_poses());
    talk::add_to_script(job.speech, job.script);
    for (const fs::path& file : job.speech.files)
        job.recordings.push_back({file, sha256_of_file(file)});
    if (request.against) {
        job.reference = track::read_script(inputs.script(*request.against)->json, channels,
                                           rig.facs, rig.expressions);
        talk::add_to_script(talk::plan_speech(job.reference->says, job.reference->header,
                                              job.rig->files, inputs.mouth_poses()),
                            *job.reference);
    }
    if (request.shapes) job.shapes = shapes_input(*request.shapes, job.rig->files);
}

}  // namespace

std::string quality_of(const RenderRequest& request) {
    return request.quality.value_or(request.draft ? "draft" : request.shapes ? "preview" : "video");
}

RenderJob plan_render_job(const RenderRequest& request) {
    RenderInputs inputs;
    return plan_render_job(request, inputs);
}

RenderJob plan_render_job(const RenderRequest& request, RenderInputs& inputs) {
    const report::Stopwatch planning;
    RenderJob job;
    const ScriptInput script = script_input(request, inputs);
    job.script_file = {request.script, script.sha256};
    job.script.header = track::read_script_header(script.json);
    if (!request.rig) existing_file(script.json.at("rig"));

    // Fast checks come first.
    job.quality = face::quality_named(quality_of(request));
    plan_rate(request, job);
    plan_view(request, job);
    check_show(request, job);
    check_marks(request.marks, job);
    plan_passes(request, job);
    job.video = video_options(request, job);
    // Scales, lines and marks are drawn with 8 bits only.
    job.view.deep = job.video.bits == 16 && job.view.show == render::Show::kSkin;
    plan_times(request, job);

    plan_rig_and_script(request, script.json, inputs, job);
    check_pulls(request, script.json, job);
    add_spoken_sound(request, job);
    job.scale = request.scale;
    job.marks = request.marks;
    job.flipped_motion = request.flipped_motion;
    job.threads = request.threads;
    job.out = request.out;
    job.landmarks = request.landmarks;
    job.emg = request.emg;
    job.planning_s = planning.seconds();
    return job;
}

}  // namespace risorius::animate
