// risorius render SCRIPT -o OUT
#include <cstdio>
#include <nlohmann/json.hpp>

#include "risorius/animate/animate.h"
#include "tools/risorius/commands.h"
#include "tools/risorius/render_options.h"

namespace risorius::cli {

namespace {

struct RenderArguments {
    Common common;
    animate::AnimateOptions options;
    std::string size;
};

void run(RenderArguments& arguments) {
    settle_view(arguments.options, arguments.size);
    animate::RunRecord record;
    {
        ProgressBar bar(arguments.common);
        record = animate::animate(arguments.options, bar.monitor());
    }
    if (arguments.common.json) {
        std::printf("%s\n", record.json().dump(2).c_str());
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
                    "A square in a corner, black or white: upper_left, upper_right, lower_left or "
                    "lower_right")
        ->group(kMarks);
    command
        .add_option(
            "--photodiode-shows", marks.photodiode_shows,
            "When it is white: frames, in every other one, or events, in the frame with which "
            "an expression or blink begins")
        ->capture_default_str()
        ->group(kMarks);
    command.add_option("--photodiode-size", marks.photodiode_px, "Side of the square, pixels")
        ->capture_default_str()
        ->group(kMarks);
    command
        .add_option("--frame-counter", marks.frame_counter,
                    "The frame's number in a corner, as 24 black and white cells: white, black, 20 "
                    "bits, a cell that makes the white bits even, white")
        ->group(kMarks);
    command.add_option("--frame-counter-size", marks.frame_counter_px, "Side of a cell, pixels")
        ->capture_default_str()
        ->group(kMarks);
}

}  // namespace

void add_render(CLI::App& app) {
    CLI::App* command = app.add_subcommand("render", "Script to video, PNG frames or a still");
    auto arguments = std::make_shared<RenderArguments>();
    animate::AnimateOptions& options = arguments->options;
    command->add_option("SCRIPT", options.script, "The script")->required();
    command
        ->add_option(
            "-o,--out", options.out,
            "What to write: .mp4 or .mov (H.264), .mkv (lossless), .webm (VP9), a folder of "
            "PNG frames when it ends in /, or .png with --still. Beside it come OUT.json, how it "
            "was made, and OUT.frames.tsv, a row "
            "per frame")
        ->required();
    command->add_option("--rig", options.rig, "Another rig than the script's");
    command->add_option("--shapes", options.shapes,
                        "shapes.glb of risorius shapes: the script's drives become weights of "
                        "these blend shapes and "
                        "their correctives, and nothing is simulated");
    command->add_option("--fps", options.fps, "Another frame rate, 1 to 240");
    command->add_option(
        "--show", options.show,
        "Another sight of the face: skin; muscles, coloured by their activation under "
        "translucent skin; wire, the edges of the mesh; strain of the skin; error, the "
        "distance from another script's face; landmarks");
    command->add_option("--against", options.against, "With --show error: the other script");
    command->add_option(
        "--scale", options.scale,
        "With --show strain or error: where its colours end, a ratio (0.4) or mm (5)");
    command->add_option("--still", options.still_s, "One picture, of this time in seconds");
    command->add_option(
        "--turntable", options.turntable_s,
        "The face of this time, in seconds, turned once round while the video lasts");
    command->add_option("--shutter", options.shutter_deg,
                        "Motion blur: how long the shutter is open, 0 to 360 degrees of a frame, "
                        "around the frame's time; 180 is usual");
    command->add_flag("--landmarks", options.landmarks,
                      "Write the landmarks into the table too: mm in space and pixels");
    command->add_flag("--emg", options.emg,
                      "Write into the table what surface electrodes would record of every muscle");
    add_view(*command, options, arguments->size);
    add_coding(*command, options);
    add_marks(*command, options.marks);
    command
        ->add_option("--passes", options.passes,
                     "Ground truth of every frame into the folder OUT.passes: segmentation, depth, "
                     "normals, flow (pixels to the next frame, from the mesh itself), masks (face "
                     "oval, eyes, mouth); several with commas. PNG and OpenEXR, results.json names "
                     "the parts")
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
