// SPDX-License-Identifier: MIT
// risorius sheet SCRIPT... --times T,T,... -o OUT.png
#include <cstdio>
#include <nlohmann/json.hpp>

#include "risorius/animate/sheet.h"
#include "risorius/core/json_text.h"
#include "tools/risorius/commands.h"
#include "tools/risorius/render_options.h"

namespace risorius::cli {

namespace {

struct SheetArguments {
    Common common;
    animate::SheetOptions options;
    std::string size = "256x256";
};

void run_sheet(SheetArguments& arguments) {
    finish_view(arguments.options.view, arguments.size);
    Json record;
    {
        ProgressBar bar(arguments.common);
        record = animate::make_sheet(arguments.options, bar.monitor());
    }
    if (arguments.common.json)
        std::printf("%s\n", json_text(record, 2).c_str());
    else if (!arguments.common.quiet)
        std::printf("%s: %zu x %zu pictures\n", arguments.options.out.string().c_str(),
                    record["runs"].size(), arguments.options.times_s.size());
}

}  // namespace

void add_sheet(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "sheet", "Show frames of scripts on one picture, a row for each script and head");
    auto arguments = std::make_shared<SheetArguments>();
    animate::SheetOptions& options = arguments->options;
    command->add_option("SCRIPT", options.scripts, "One or more scripts")->required();
    command
        ->add_option("--times", options.times_s,
                     "Times in seconds, separated by commas: a column for each")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->required();
    command
        ->add_option(
            "-o,--out", options.out,
            "The picture to write, .png. OUT.json, the record of the runs, is written beside it")
        ->required();
    command->add_option(
        "--rig", options.rigs,
        "Use this rig instead of the scripts'; given several times: a row for each");
    command
        ->add_option(
            "--cameras", options.cameras,
            "Several views instead of --camera, separated by commas: a column for each view at "
            "each time. front, three_quarter, profile, top, eye, nose, mouth, ear ...")
        ->delimiter(',')
        ->allow_extra_args(false);
    command
        ->add_option("--captions", options.captions,
                     "Headings of the columns, separated by commas, instead of times and views")
        ->delimiter(',')
        ->allow_extra_args(false);
    command
        ->add_option(
            "--beside", options.beside,
            "PNG pictures to compare with, separated by commas; each gets a row of its own")
        ->delimiter(',')
        ->allow_extra_args(false);
    command->add_option(
        "--show", options.view.show,
        "What to show: skin, muscles, skull, wire, strain, landmarks or articulation");
    add_view(*command, options.view, arguments->size);
    command->get_option("--size")
        ->description("Size of one picture in pixels")
        ->capture_default_str();
    add_common(*command, arguments->common);
    command->footer(
        "Example:\n  risorius sheet samples/smile/script.json samples/jaw/script.json --times "
        "0,0.5,1 -o sheet.png");
    command->callback([arguments] { run_sheet(*arguments); });
}

}  // namespace risorius::cli
