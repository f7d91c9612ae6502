// SPDX-License-Identifier: MIT
// risorius render SCRIPT -o OUT
#include <cstdio>
#include <nlohmann/json.hpp>

#include "risorius/animate/animate.h"
#include "risorius/core/json_text.h"
#include "tools/risorius/commands.h"
#include "tools/risorius/render_options.h"

namespace risorius::cli {

namespace {

struct RenderArguments {
    Common common;
    animate::RenderRequest options;
    std::string size;
};

void run(RenderArguments& arguments) {
    finish_view(arguments.options, arguments.size);
    animate::RunRecord record;
    {
        ProgressBar bar(arguments.common);
        record = animate::animate(arguments.options, bar.monitor());
    }
    if (arguments.common.json) {
        std::printf("%s\n", json_text(record.json(), 2).c_str());
        return;
    }
    if (arguments.common.quiet) return;
    for (const std::string& warning : record.warnings)
        std::fprintf(stderr, "note: %s\n", warning.c_str());
    std::printf("%s: %d frame%s of %d x %d", record.out.string().c_str(), record.frames,
                record.frames == 1 ? "" : "s", record.width_px, record.height_px);
    if (!arguments.options.still_s) std::printf(" at %d fps", record.fps);
    std::printf(
        ", %.1f s (set up in %.1f s, simulated in %.1f s, drawn in %.1f s, written in %.1f s)\n",
        record.timing.total_s, record.timing.build_s, record.timing.simulate_s,
        record.timing.draw_s, record.timing.encode_s);
}

void add_marks(CLI::App& command, animate::SyncMarks& marks) {
    constexpr const char* kMarks = "Marks for machines that watch the screen";
    command
        .add_option("--photodiode", marks.photodiode,
                    "Draw a black or white square in a corner: upper_left, upper_right, lower_left "
                    "or lower_right")
        ->group(kMarks);
    command
        .add_option("--photodiode-shows", marks.photodiode_shows,
                    "When the square is white. frames: in every other frame; events: in the frame "
                    "with which an expression or blink begins")
        ->capture_default_str()
        ->group(kMarks);
    command.add_option("--photodiode-size", marks.photodiode_px, "Side of the square in pixels")
        ->capture_default_str()
        ->group(kMarks);
    command
        .add_option("--frame-counter", marks.frame_counter,
                    "Draw the number of the frame in a corner, as 24 black and white cells: white, "
                    "black, 20 bits, a parity cell, white")
        ->group(kMarks);
    command.add_option("--frame-counter-size", marks.frame_counter_px, "Side of a cell in pixels")
        ->capture_default_str()
        ->group(kMarks);
}

}  // namespace

void add_render(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("render", "Render a script to a video, PNG frames or a still");
    auto arguments = std::make_shared<RenderArguments>();
    animate::RenderRequest& options = arguments->options;
    command->add_option("SCRIPT", options.script, "The script")->required();
    command
        ->add_option(
            "-o,--out", options.out,
            "The file to write: .mp4 or .mov (H.264), .mkv (lossless), .webm (VP9), a folder of "
            "PNG frames when it ends in /, or .png with --still. OUT.json, the record of the run, "
            "and OUT.frames.tsv, a table with a row for each frame, are written beside it")
        ->required();
    command->add_option("--rig", options.rig, "Use this rig instead of the script's");
    command->add_option("--shapes", options.shapes,
                        "A file shapes.glb of risorius shapes: play the script with its blend "
                        "shapes and correctives, without simulation");
    command->add_option("--fps", options.fps,
                        "Frames per second instead of the script's, 1 to 240");
    command->add_option(
        "--show", options.show,
        "What to show: skin; muscles, coloured by activation under translucent "
        "skin; skull; wire, the edges of the mesh; strain of the skin; error, the "
        "distance from the face of another script; landmarks; articulation, the mouth "
        "in section");
    command->add_option("--against", options.against,
                        "With --show error: the script to compare with");
    command->add_option("--scale", options.scale,
                        "End of the colour scale with --show strain, a ratio (default: 0.4), or "
                        "--show error, mm (default: 5)");
    command->add_option("--still", options.still_s, "Render one picture, at this time in seconds");
    command->add_option(
        "--turntable", options.turntable_s,
        "Show the face at this time in seconds, and turn the head once round during the video");
    command->add_option(
        "--shutter", options.shutter_deg,
        "Motion blur: the time for which the shutter is open, 0 to 360 degrees (360: the whole "
        "frame), centred on the frame's time. Default: 0; common: 180");
    command->add_flag("--landmarks", options.landmarks,
                      "Add the landmarks to the frame table, in mm (head frame) and in pixels");
    command->add_flag("--emg", options.emg,
                      "Add a simulated surface electromyogram of every muscle to the frame table");
    add_view(*command, options, arguments->size);
    add_coding(*command, options);
    add_marks(*command, options.marks);
    command
        ->add_option("--passes", options.passes,
                     "Write ground truth of every frame into the folder OUT.passes: segmentation, "
                     "depth, normals, flow (pixels to the next frame, computed from the mesh), "
                     "masks (face oval, eyes, mouth); separate several with commas. Files are PNG "
                     "and OpenEXR; OUT.passes/results.json names the part for each number of the "
                     "segmentation")
        ->delimiter(',')
        ->allow_extra_args(false);
    add_common(*command, arguments->common);
    command->footer(
        "Example:\n  risorius render samples/hello/script.json -o hello.mp4\n"
        "  risorius render samples/smile/script.json --still 1.0 --size 512x512 -o smile.png\n"
        "  risorius render samples/hello/script.json --shapes adult/shapes.glb -o linear.mp4\n"
        "  risorius render mine/script.json --audio mine/voice.wav --audio-offset -480 -o "
        "talk.mp4\n"
        "  risorius render mine/script.json --fps 120 --lossless --photodiode lower_left "
        "--frame-counter upper_left -o trial.mkv");
    command->callback([arguments] { run(*arguments); });
}

}  // namespace risorius::cli
