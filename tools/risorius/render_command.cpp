// risorius render SCRIPT -o OUT
#include <cstdio>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/animate.h"
#include "commands.h"
#include "core/error.h"

namespace risorius::cli {

namespace {

app::PictureSize size_from(const std::string& text) {
    app::PictureSize size;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%5dx%5d%c", &size.width_px, &size.height_px, &rest) != 2)
        throw Error("--size", "WIDTHxHEIGHT in pixels, as 1024x1024", "\"" + text + "\"");
    return size;
}

struct RenderArguments {
    Common common;
    app::AnimateOptions options;
    std::string size;
};

void run(RenderArguments& arguments) {
    const int threads = arguments.options.threads;
    if (threads < 1 || threads > 256)
        throw Error("--threads", "an integer in [1, 256]", std::to_string(threads));
    if (!arguments.size.empty()) arguments.options.size = size_from(arguments.size);
    app::RunRecord record;
    {
        ProgressBar bar(arguments.common);
        record = app::animate(arguments.options, bar.watch());
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
    std::printf(", %.1f s (simulated in %.1f s, drawn in %.1f s, written in %.1f s)\n",
                record.timing.total_s, record.timing.simulate_s, record.timing.draw_s,
                record.timing.encode_s);
}

}  // namespace

void add_render(CLI::App& app) {
    CLI::App* command = app.add_subcommand("render", "Script to video, PNG frames or a still");
    auto arguments = std::make_shared<RenderArguments>();
    app::AnimateOptions& options = arguments->options;
    options.threads = static_cast<int>(std::max(2u, std::thread::hardware_concurrency()));
    command->add_option("SCRIPT", options.script, "The script")->required();
    command
        ->add_option("-o,--out", options.out,
                     "What to write: .mp4, .mkv (lossless), a folder of PNG frames when it ends in "
                     "/, or .png with "
                     "--still. Beside it come OUT.json, how it was made, and OUT.frames.tsv, a row "
                     "per frame")
        ->required();
    command->add_option("--rig", options.rig, "Another rig than the script's");
    command->add_option("--size", arguments->size, "Another size of the picture, as 1024x1024");
    command->add_option("--fps", options.fps, "Another frame rate, 1 to 240");
    command->add_option(
        "--camera", options.camera,
        "Another view: front, three_quarter, three_quarter_right, profile, profile_right");
    command->add_option("--show", options.show,
                        "Another sight of the face: skin, or muscles, which are coloured by their "
                        "activation under translucent skin");
    command->add_option("--still", options.still_s, "One picture, of this time in seconds");
    command
        ->add_option("--quality", options.quality,
                     "How carefully to simulate: preview, video or fine")
        ->capture_default_str();
    command->add_flag("--landmarks", options.landmarks,
                      "Write the landmarks into the table too: mm in space and pixels");
    command->add_flag("--emg", options.emg,
                      "Write into the table what surface electrodes would record of every muscle");
    command
        ->add_option(
            "--threads", options.threads,
            "1, or more to simulate beside drawing and to draw faster; the frames are the same")
        ->capture_default_str();
    add_common(*command, arguments->common);
    command->footer(
        "Example:\n  risorius render samples/hello/script.json -o hello.mp4\n"
        "  risorius render samples/smile/script.json --still 1.0 --size 512x512 -o smile.png");
    command->callback([arguments] { run(*arguments); });
}

}  // namespace risorius::cli
