// SPDX-License-Identifier: MIT
// risorius export SCRIPT -o DIR
#include <cstdio>
#include <nlohmann/json.hpp>

#include "risorius/animate/export_fields.h"
#include "risorius/core/json_text.h"
#include "tools/risorius/commands.h"

namespace risorius::cli {

namespace {

struct ExportArguments {
    Common common;
    animate::ExportOptions options;
};

void run_export(const ExportArguments& arguments) {
    Json record;
    {
        ProgressBar bar(arguments.common);
        record = animate::export_fields(arguments.options, bar.monitor());
    }
    if (arguments.common.json) {
        std::printf("%s\n", json_text(record, 2).c_str());
        return;
    }
    if (arguments.common.quiet) return;
    const bool fields = record.contains("meshes");
    if (fields) {
        for (const auto& [name, mesh] : record["meshes"].items())
            std::printf("%-8s %7d points %7d cells\n", name.c_str(), mesh["points"].get<int>(),
                        mesh["cells"].get<int>());
    } else {
        std::printf("%d muscles\n", static_cast<int>(record["muscles"].size()));
    }
    const std::filesystem::path first = arguments.options.out / (fields ? "face.pvd" : "face.osim");
    std::printf("%s: %d frames\n", first.string().c_str(), record["frames"].get<int>());
}

}  // namespace

void add_export(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "export",
        "Write a script for other programs: fields of tissue, muscles and skin for ParaView, or "
        "muscles for OpenSim");
    auto arguments = std::make_shared<ExportArguments>();
    animate::ExportOptions& options = arguments->options;
    command->add_option("SCRIPT", options.script, "A script")->required();
    command
        ->add_option("-o,--out", options.out,
                     "The folder to write: DIR/face.pvd or DIR/face.osim with its files, and "
                     "DIR/results.json")
        ->required();
    command
        ->add_option("--format", options.format,
                     "vtu: unstructured grids and surfaces of VTK in XML, with series over time; "
                     "osim: the muscles as a model of OpenSim, with activations over time")
        ->capture_default_str();
    command
        ->add_option("--encoding", options.encoding,
                     "appended: binary numbers at the end of the file; ascii: numbers as text")
        ->capture_default_str();
    command->add_option("--rig", options.rig, "Use this rig instead of the script's");
    command->add_option("--fps", options.fps, "Frames per second; default: those of the script");
    command
        ->add_option("--times", options.times_s,
                     "Only these times in seconds, separated by commas, ascending")
        ->delimiter(',')
        ->allow_extra_args(false);
    command
        ->add_option("--quality", options.quality,
                     "Quality of the simulation: draft, preview, video or fine")
        ->capture_default_str();
    add_common(*command, arguments->common);
    command->footer(
        "Example:\n  risorius export samples/smile/script.json --times 0,0.5,1 -o smile_fields");
    command->callback([arguments] { run_export(*arguments); });
}

}  // namespace risorius::cli
