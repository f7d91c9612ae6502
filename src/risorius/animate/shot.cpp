#include "risorius/animate/shot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "risorius/animate/detail/pass_writer.h"
#include "risorius/core/error.h"
#include "risorius/core/existing_file.h"
#include "risorius/core/known_names.h"
#include "risorius/media/hdr_file.h"
#include "risorius/media/sync_marks.h"

namespace risorius::animate {

std::string Shot::background_text() const {
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

media::VideoOptions video_options(const AnimateOptions& options, const Shot& shot) {
    media::VideoOptions video = options.video;
    video.width_px = shot.view.width_px;
    video.height_px = shot.view.height_px;
    video.fps = shot.script.fps;
    video.alpha = shot.view.background.transparent;
    const bool is_h264 =
        options.out.extension() == ".mp4" || (options.out.extension() == ".mov" && !video.alpha);
    if (options.draft && is_h264 && !video.preset) video.preset = "ultrafast";
    if (options.audio_offset && !options.audio)
        throw Error(option_name("audio_offset"), "a recording to place, by " + option_name("audio"),
                    "none");
    if (!options.audio) return video;
    video.sound = std::make_shared<media::Sound>(media::read_recording(*options.audio));
    video.sound_offset_samples = options.audio_offset.value_or(0);
    const double at_s = static_cast<double>(video.sound_offset_samples) / video.sound->rate_hz;
    const double length_s = static_cast<double>(video.sound->length()) / video.sound->rate_hz;
    if (at_s >= shot.script.duration_s || at_s + length_s <= 0)
        throw Error(
            option_name("audio_offset"), "some of the recording within the video",
            std::to_string(video.sound_offset_samples) + " samples, " + format_number(at_s) + " s");
    return video;
}

std::string times_of(const Shot& shot) {
    return "a time in [0, " + format_number(shot.script.duration_s) + "]";
}

/// A still has neither sound nor an encoder.
void check_still(const AnimateOptions& options) {
    const media::VideoOptions& video = options.video;
    for (const auto& [given, name] :
         {std::pair{options.audio.has_value(), option_name("audio")},
          std::pair{video.crf.has_value(), option_name("crf")},
          std::pair{video.preset.has_value(), option_name("preset")},
          std::pair{video.pixels.has_value(), option_name("pixels")},
          std::pair{video.keyframe_interval.has_value(), option_name("keyframe_interval")},
          std::pair{video.lossless, option_name("lossless")}})
        if (given) throw Error(name, "a video to encode", option_name("still_s"));
}

void check_marks(const SyncMarks& marks, const Shot& shot) {
    const int smaller = std::min(shot.view.width_px, shot.view.height_px);
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
    const int largest = shot.view.width_px / media::kCounterCells;
    if (marks.frame_counter_px < 2 || marks.frame_counter_px > largest)
        throw Error(option_name("frame_counter_size"),
                    "pixels in [2, " + std::to_string(largest) + "], " +
                        std::to_string(media::kCounterCells) + " cells side by side",
                    std::to_string(marks.frame_counter_px));
    const auto is_upper = [](const std::string& corner) { return corner.starts_with("upper"); };
    if (marks.photodiode && (marks.photodiode == marks.frame_counter ||
                             (is_upper(*marks.photodiode) == is_upper(*marks.frame_counter) &&
                              media::kCounterCells * marks.frame_counter_px + marks.photodiode_px >
                                  shot.view.width_px)))
        throw Error(option_name("frame_counter"),
                    "a place that the photodiode's square leaves free",
                    "\"" + *marks.frame_counter + "\"");
}

}  // namespace

std::string quality_of(const AnimateOptions& options) {
    return options.quality.value_or(options.draft ? "draft" : options.shapes ? "preview" : "video");
}

Shot plan_shot(const AnimateOptions& options) {
    Shot shot;
    shot.script = track::read_script_header(options.script);
    if (options.rig)
        shot.script.rig_file = *options.rig;
    else
        existing_file(JsonCursor::read_file(options.script).at("rig"));
    if (options.fps) {
        if (*options.fps < 1 || *options.fps > 240)
            throw Error(option_name("fps"), "an integer in [1, 240]", std::to_string(*options.fps));
        shot.script.fps = *options.fps;
    }
    shot.frames = shot.script.frame_count();
    if (shot.frames < 1)
        throw Error(option_name("fps"),
                    "at least one frame in " + format_number(shot.script.duration_s) + " s",
                    std::to_string(shot.script.fps));
    const track::ScriptView& asked = shot.script.view;
    shot.view.width_px = options.size ? options.size->width_px : asked.width_px;
    shot.view.height_px = options.size ? options.size->height_px : asked.height_px;
    shot.view.camera = options.camera.value_or(asked.camera);
    shot.view.show = render::show_named(options.show.value_or(asked.show), option_name("show"));
    shot.view.background = {.transparent = asked.transparent, .rgb = asked.background_rgb};
    shot.view.lens = {.orthographic = asked.orthographic,
                      .distance_m = asked.distance_m,
                      .view_angle_deg = asked.view_angle_deg,
                      .aperture_mm = asked.aperture_mm};
    shot.view.draft = options.draft;
    shot.view.supersampling = options.antialiasing.value_or(options.draft ? 1 : asked.antialiasing);
    if (shot.view.supersampling < 1 || shot.view.supersampling > 4)
        throw Error(option_name("antialiasing"), "samples per pixel and side in [1, 4]",
                    std::to_string(shot.view.supersampling));
    shot.shutter_deg = options.shutter_deg.value_or(asked.shutter_deg);
    if (!(shot.shutter_deg >= 0 && shot.shutter_deg <= 360))
        throw Error(option_name("shutter_deg"), "degrees in [0, 360]",
                    format_number(shot.shutter_deg));
    shot.view.light.preset = asked.light.preset;
    shot.view.light.turn_deg = asked.light.turn_deg;
    shot.view.light.exposure_ev = asked.light.exposure_ev;
    if (!asked.light.file.empty()) {
        media::HdrPicture map = media::read_hdr(asked.light.file);
        if (map.width != 2 * map.height)
            throw Error(asked.light.file.string(), "a map twice as wide as high",
                        std::to_string(map.width) + "x" + std::to_string(map.height));
        shot.view.light.surroundings =
            render::Surroundings{map.width, map.height, std::move(map.rgb)};
    }
    // All films of a process draw on the driver's threads, one picture after another: as many as draw
    const int drawing = options.threads * options.films_at_once;
    shot.view.threads = drawing > 1 ? drawing : 0;

    // Refuse now what would only fail after minutes
    index_of_name(option_name("camera"), shot.view.camera, render::camera_names());
    for (int side : {shot.view.width_px, shot.view.height_px})
        if (side < 16 || side > 8192)
            throw Error(option_name("size"), "a width and a height in [16, 8192]",
                        std::to_string(side));
    const bool compared = shot.view.show == render::Show::kError;
    if (compared != options.against.has_value())
        throw compared
            ? Error(option_name("show") + " error",
                    "a script to compare with, by " + option_name("against"), "none")
            : Error(option_name("against"), option_name("show") + " error, which compares",
                    option_name("show") + " " + options.show.value_or(asked.show));
    if (options.scale) {
        if (!compared && shot.view.show != render::Show::kStrain)
            throw Error(option_name("scale"),
                        option_name("show") + " strain or error, which have one",
                        option_name("show") + " " + options.show.value_or(asked.show));
        if (!(*options.scale > 0 && *options.scale <= 1000))
            throw Error(option_name("scale"), "a number in (0, 1000]",
                        format_number(*options.scale));
    }
    if (options.shapes) {
        if (shot.view.show == render::Show::kMuscles)
            throw Error(option_name("shapes"),
                        "a sight of the skin, as blend shapes move no muscles",
                        option_name("show") + " muscles");
        if (shot.script.jaw == track::JawDrive::kMuscles)
            throw Error(options.script.string() + ":/jaw",
                        "\"channels\" with " + option_name("shapes") +
                            ", which open the jaw as channels say",
                        "\"muscles\"");
    }
    check_marks(options.marks, shot);
    for (const std::string& pass : options.passes) {
        index_of_name(option_name("passes"), pass, pass_names());
        if (pass == "flow" && options.still_s)
            throw Error(option_name("passes"), "passes of one frame with " + option_name("still_s"),
                        "\"flow\", to the next one");
    }
    shot.video = video_options(options, shot);
    // Scales, lines and marks are drawn in 8 bits
    shot.view.deep = shot.video.bits == 16 && shot.view.show == render::Show::kSkin;
    if (!options.times_s.empty()) {
        shot.times_s = options.times_s;
        shot.frames = static_cast<int>(options.times_s.size());
        shot.first_s = options.times_s.front();
        for (const double time_s : options.times_s)
            if (!(time_s >= 0 && time_s <= shot.script.duration_s))
                throw Error(option_name("times_s"), times_of(shot), format_number(time_s));
        return shot;
    }
    if (options.turntable_s) {
        if (options.still_s)
            throw Error(option_name("turntable_s"), "no " + option_name("still_s") + " beside it",
                        "both");
        if (!(*options.turntable_s >= 0 && *options.turntable_s <= shot.script.duration_s))
            throw Error(option_name("turntable_s"), times_of(shot),
                        format_number(*options.turntable_s));
        shot.first_s = *options.turntable_s;
        shot.still_time = true;
    }
    if (!options.still_s) {
        media::check_target(options.out, shot.video);
        return shot;
    }
    check_still(options);
    if (!(*options.still_s >= 0 && *options.still_s <= shot.script.duration_s))
        throw Error(option_name("still_s"), times_of(shot), format_number(*options.still_s));
    if (options.out.extension() != ".png")
        throw Error(options.out.string(), "an ending of .png for a still",
                    "\"" + options.out.extension().string() + "\"");
    shot.frames = 1;
    shot.first_s = *options.still_s;
    return shot;
}

}  // namespace risorius::animate
