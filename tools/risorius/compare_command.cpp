// SPDX-License-Identifier: MIT
// risorius compare SCRIPT [SCRIPT] -o OUT
#include <cstdio>
#include <nlohmann/json.hpp>

#include "risorius/animate/compare.h"
#include "risorius/core/error.h"
#include "risorius/core/json_text.h"
#include "tools/risorius/commands.h"
#include "tools/risorius/render_options.h"

namespace risorius::cli {

namespace {

struct CompareArguments {
    Common common;
    animate::RenderRequest options;
    std::vector<std::filesystem::path> scripts, rigs;
    std::string size;
};

void run_compare(CompareArguments& arguments) {
    finish_view(arguments.options, arguments.size);
    const auto &scripts = arguments.scripts, &rigs = arguments.rigs;
    if (scripts.size() > 2)
        throw Error("compare", "one or two scripts", std::to_string(scripts.size()));
    if (rigs.size() > 2) throw Error("--rig", "at most two of them", std::to_string(rigs.size()));
    if (scripts.size() < 2 && rigs.size() < 2)
        throw Error("compare", "two scripts, or one and two times --rig", "nothing to tell apart");
    animate::RenderRequest left = arguments.options, right = arguments.options;
    left.script = scripts.front();
    right.script = scripts.back();
    if (!rigs.empty()) {
        left.rig = rigs.front();
        right.rig = rigs.back();
    }
    Json record;
    {
        ProgressBar bar(arguments.common);
        record = animate::compare(left, right, bar.monitor());
    }
    if (arguments.common.json)
        std::printf("%s\n", json_text(record, 2).c_str());
    else if (!arguments.common.quiet)
        std::printf("%s: %d frames side by side\n", left.out.string().c_str(),
                    record["frames"].get<int>());
}

}  // namespace

void add_compare(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("compare", "Render two scripts or two heads side by side");
    auto arguments = std::make_shared<CompareArguments>();
    animate::RenderRequest& options = arguments->options;
    command
        ->add_option("SCRIPT", arguments->scripts,
                     "Two scripts, for the left and the right half of the picture, or one script "
                     "with --rig given twice")
        ->required();
    command
        ->add_option("-o,--out", options.out,
                     "The file to write: a video or a folder of PNG frames, as for risorius "
                     "render. OUT.json, OUT.left.frames.tsv and "
                     "OUT.right.frames.tsv are written beside it")
        ->required();
    command->add_option("--rig", arguments->rigs,
                        "Rig instead of the script's; give it twice for the left and the right "
                        "half of the picture");
    command->add_option("--fps", options.fps,
                        "Frames per second instead of the script's, 1 to 240");
    command->add_option(
        "--show", options.show,
        "What to show: skin, muscles, skull, wire, strain, landmarks or articulation");
    add_view(*command, options, arguments->size);
    add_coding(*command, options);
    add_common(*command, arguments->common);
    command->footer(
        "Example:\n  risorius compare samples/smile/script.json --rig rigs/adult/rig.json --rig "
        "anna/rig.json -o heads.mp4\n"
        "  risorius compare mine/weak.json mine/strong.json --size 512x512 -o both.mp4");
    command->callback([arguments] { run_compare(*arguments); });
}

}  // namespace risorius::cli
