// SPDX-License-Identifier: MIT
#include "tools/risorius/render_options.h"

#include <algorithm>
#include <cstdio>
#include <thread>

#include "risorius/core/error.h"
#include "risorius/render/gl_choice.h"

namespace risorius::cli {

animate::PictureSize size_from(const std::string& text) {
    animate::PictureSize size;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%5dx%5d%c", &size.width_px, &size.height_px, &rest) != 2)
        throw Error("--size", "WIDTHxHEIGHT in pixels, as 1024x1024", "\"" + text + "\"");
    return size;
}

void add_coding(CLI::App& command, animate::RenderRequest& options) {
    constexpr const char* kCoding = "How the video is encoded";
    media::VideoOptions& video = options.video;
    command
        .add_option("--crf", video.crf,
                    "Constant rate factor, lower is better: 0 to 51 for H.264 (default: 18), 0 to "
                    "63 for VP9 (default: 24)")
        ->type_name("INT")
        ->group(kCoding);
    command
        .add_option("--preset", video.preset,
                    "Preset of H.264, ultrafast to placebo: slower presets make smaller files")
        ->group(kCoding);
    command
        .add_option(
            "--pixels", video.pixels,
            "yuv420p, which every player reads, or yuv444p, which keeps colour at full resolution")
        ->group(kCoding);
    command
        .add_option("--keyframe-interval", video.keyframe_interval,
                    "Frames from one key frame to the next; 1: every frame is a key frame. "
                    "Default: one key frame every quarter of a second")
        ->type_name("INT")
        ->group(kCoding);
    command
        .add_flag("--lossless", video.lossless,
                  "Keep every pixel exactly: H.264 or VP9 in RGB, or PNG in a transparent .mov")
        ->group(kCoding);
    command.add_option("--bits", video.bits, "Bits per channel of PNG frames and .mkv, 8 or 16")
        ->type_name("INT")
        ->group(kCoding);
    command
        .add_option("--audio", options.audio,
                    "A recording, WAV or FLAC, to add as sound: PCM in .mkv and .mov, AAC in .mp4, "
                    "Opus in .webm. It is cut or padded with silence to the length of the video")
        ->group(kCoding);
    command
        .add_option("--audio-offset", options.audio_offset,
                    "Samples from the first frame to the first sample of the recording; negative "
                    "when the recording begins earlier")
        ->type_name("INT")
        ->group(kCoding);
    command
        .add_flag("--no-sound{false}", options.sound,
                  "Leave the speech sound of the script out of the video")
        ->group(kCoding);
}

void add_view(CLI::App& command, animate::RenderRequest& options, std::string& size) {
    options.threads = static_cast<int>(std::max(2u, std::thread::hardware_concurrency()));
    command.add_option("--size", size,
                       "Size of the picture in pixels instead of the script's, such as 1024x1024");
    command.add_option("--camera", options.camera,
                       "View instead of the script's: front, three_quarter, three_quarter_right, "
                       "profile, profile_right, top; close-ups eye, nose, mouth, ear");
    command.add_option(
        "--hair", options.hair,
        "Hair on the scalp instead of the script's. own: the hair of the rig; none: no "
        "hair, for studies that show only the face");
    command.add_option("--quality", options.quality,
                       "Quality of the simulation: draft, preview, video or fine. Default: video");
    command
        .add_option(
            "--antialiasing", options.antialiasing,
            "Samples per pixel and side, 1 to 4, instead of the script's (2 when it gives none)")
        ->type_name("INT");
    command.add_flag("--draft", options.draft,
                     "Render fast: skin is shaded at its vertices; --quality draft, --antialiasing "
                     "1 and --preset ultrafast are used unless given");
    command
        .add_option_function<std::string>(
            "--gl", [](const std::string& name) { render::choose_gl(name, "--gl"); },
            "OpenGL implementation: osmesa, on the CPU; egl; auto, which takes EGL if it finds a "
            "graphics processor, or else OSMesa. The environment variable RISORIUS_GL sets it for "
            "all commands")
        ->type_name("NAME");
    command
        .add_option("--threads", options.threads,
                    "Threads; with 2 or more, simulation and drawing run at the same time. The "
                    "frames are the same for any number")
        ->capture_default_str();
}

void finish_view(animate::RenderRequest& options, const std::string& size) {
    if (options.threads < 1 || options.threads > 256)
        throw Error("--threads", "an integer in [1, 256]", std::to_string(options.threads));
    if (!size.empty()) options.size = size_from(size);
}

}  // namespace risorius::cli
