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

void add_coding(CLI::App& command, animate::AnimateOptions& options) {
    constexpr const char* kCoding = "How the video is coded";
    media::VideoOptions& video = options.video;
    command
        .add_option("--crf", video.crf,
                    "Quality, less is better: H.264 0 to 51, 18 when not given; VP9 0 to 63, 24")
        ->type_name("INT")
        ->group(kCoding);
    command
        .add_option(
            "--preset", video.preset,
            "Of H.264, ultrafast to placebo, about faster when not given: slower is smaller")
        ->group(kCoding);
    command
        .add_option(
            "--pixels", video.pixels,
            "yuv420p, which every player knows, or yuv444p, which keeps colour at full size")
        ->group(kCoding);
    command
        .add_option(
            "--keyframe-interval", video.keyframe_interval,
            "Frames from one key frame to the next, a quarter of a second when not given; 1: "
            "every frame stands alone")
        ->type_name("INT")
        ->group(kCoding);
    command
        .add_flag("--lossless", video.lossless,
                  "Every pixel as it was drawn: H.264 or VP9 in RGB, or PNG in a transparent .mov")
        ->group(kCoding);
    command.add_option("--bits", video.bits, "Of PNG frames, 8 or 16 per channel")
        ->type_name("INT")
        ->group(kCoding);
    command
        .add_option(
            "--audio", options.audio,
            "A recording, WAV or FLAC: PCM in .mkv and .mov, AAC in .mp4, Opus in .webm. It is "
            "cut, or filled up with silence, to the length of the video")
        ->group(kCoding);
    command
        .add_option("--audio-offset", options.audio_offset,
                    "Samples of the recording from the first frame to its first sample; below 0 it "
                    "has begun before")
        ->type_name("INT")
        ->group(kCoding);
}

void add_view(CLI::App& command, animate::AnimateOptions& options, std::string& size) {
    options.threads = static_cast<int>(std::max(2u, std::thread::hardware_concurrency()));
    command.add_option("--size", size, "Another size of the picture, as 1024x1024");
    command.add_option("--camera", options.camera,
                       "Another view: front, three_quarter, three_quarter_right, profile, "
                       "profile_right, top; close-ups eye, nose, mouth, ear");
    command.add_option("--quality", options.quality,
                       "How carefully to simulate: draft, preview, video (when not given) or fine");
    command
        .add_option(
            "--antialiasing", options.antialiasing,
            "Samples per pixel and side, 1 to 4, another number than the script's, 2 when it "
            "gives none")
        ->type_name("INT");
    command.add_flag(
        "--draft", options.draft,
        "Quickly, to look at: skin lit at its vertices, and --quality draft, --antialiasing 1 "
        "and --preset ultrafast unless given");
    command
        .add_option_function<std::string>(
            "--gl", [](const std::string& name) { render::choose_gl(name, "--gl"); },
            "What draws: osmesa, in memory; egl, where there is EGL; auto, EGL where it has a "
            "graphics "
            "processor, or else OSMesa. The environment's RISORIUS_GL does the same for all "
            "commands")
        ->type_name("NAME");
    command
        .add_option(
            "--threads", options.threads,
            "1, or more to simulate beside drawing and to draw several frames at once; the frames "
            "are the same")
        ->capture_default_str();
}

void settle_view(animate::AnimateOptions& options, const std::string& size) {
    if (options.threads < 1 || options.threads > 256)
        throw Error("--threads", "an integer in [1, 256]", std::to_string(options.threads));
    if (!size.empty()) options.size = size_from(size);
}

}  // namespace risorius::cli
