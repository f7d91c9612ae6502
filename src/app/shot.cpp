#include "app/shot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/error.h"
#include "core/existing_file.h"

namespace risorius::app {

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

Shot plan_shot(const AnimateOptions& options) {
    Shot shot;
    shot.script = track::read_script_header(options.script);
    if (options.rig)
        shot.script.rig_file = *options.rig;
    else
        existing_file(JsonCursor::read_file(options.script).at("rig"));
    if (options.fps) {
        if (*options.fps < 1 || *options.fps > 240)
            throw Error("--fps", "an integer in [1, 240]", std::to_string(*options.fps));
        shot.script.fps = *options.fps;
    }
    shot.frames = shot.script.frame_count();
    if (shot.frames < 1)
        throw Error("--fps",
                    "at least one frame in " + format_number(shot.script.duration_s) + " s",
                    std::to_string(shot.script.fps));
    const track::ScriptView& asked = shot.script.view;
    shot.view.width_px = options.size ? options.size->width_px : asked.width_px;
    shot.view.height_px = options.size ? options.size->height_px : asked.height_px;
    shot.view.camera = options.camera.value_or(asked.camera);
    shot.view.show = render::show_named(options.show.value_or(asked.show), "--show");
    shot.view.background = {.transparent = asked.transparent, .rgb = asked.background_rgb};
    shot.view.threads = options.threads > 1 ? options.threads : 0;

    // Refuse now what would only fail after minutes
    const auto& cameras = render::camera_names();
    if (std::find(cameras.begin(), cameras.end(), shot.view.camera) == cameras.end()) {
        std::string names;
        for (const std::string& name : cameras) names += " \"" + name + "\"";
        throw Error("--camera", "one of" + names, "\"" + shot.view.camera + "\"");
    }
    for (int side : {shot.view.width_px, shot.view.height_px})
        if (side < 16 || side > 8192)
            throw Error("--size", "a width and a height in [16, 8192]", std::to_string(side));
    if (!options.still_s) {
        media::check_target(options.out, shot.video());
        if (shot.view.background.transparent && options.out.extension() == ".mp4")
            throw Error(options.out.string(), "an ending that keeps transparency, .mkv or /",
                        "\".mp4\"");
        return shot;
    }
    if (!(*options.still_s >= 0 && *options.still_s <= shot.script.duration_s))
        throw Error("--still", "a time in [0, " + format_number(shot.script.duration_s) + "]",
                    format_number(*options.still_s));
    if (options.out.extension() != ".png")
        throw Error(options.out.string(), "an ending of .png for a still",
                    "\"" + options.out.extension().string() + "\"");
    shot.frames = 1;
    shot.first_s = *options.still_s;
    return shot;
}

}  // namespace risorius::app
