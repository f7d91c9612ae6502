// SPDX-License-Identifier: MIT
// risorius check FILE...
#include <cstdio>
#include <nlohmann/json.hpp>

#include "risorius/core/error.h"
#include "risorius/core/json_cursor.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "tools/risorius/check_files.h"
#include "tools/risorius/commands.h"

namespace risorius::cli {

namespace {

struct CheckArguments {
    Common common;
    std::vector<std::filesystem::path> files;
};

// All files are checked, so that one call reports all errors. A run with the same file would give the same messages.
void run(const CheckArguments& arguments) {
    Json report = Json::array();
    int broken = 0;
    for (const std::filesystem::path& file : arguments.files) {
        cli::CheckResult result;
        {
            ProgressBar bar(arguments.common);
            result = cli::check_file(file, bar.monitor());
        }
        broken += !result.ok();
        if (!result.ok()) std::fprintf(stderr, "risorius: %s\n", result.error.c_str());
        report.push_back(json_object({{"file", file.generic_string()},
                                      {"format", result.format},
                                      {"ok", result.ok()},
                                      {"error", result.error},
                                      {"notes", result.notes}}));
        if (arguments.common.quiet || arguments.common.json || !result.ok()) continue;
        std::printf("%s: %s, fine\n", file.string().c_str(), result.format.c_str());
        for (const std::string& note : result.notes) std::printf("  note: %s\n", note.c_str());
    }
    if (arguments.common.json) std::printf("%s\n", json_text(report, 2).c_str());
    if (broken) throw SaidAlready();
}

}  // namespace

void add_check(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "check", "Check scripts, rigs, landmarks, designs, experiments and meshes");
    auto arguments = std::make_shared<CheckArguments>();
    command->add_option("FILE", arguments->files, "The files to check")->required();
    add_common(*command, arguments->common);
    command->footer(
        "A script is read with its rig, a rig with its mesh and a design with every condition. "
        "Exit code 2 when a file is "
        "wrong.\n\n"
        "Example:\n  risorius check samples/hello/script.json rigs/adult/rig.json");
    command->callback([arguments] { run(*arguments); });
}

}  // namespace risorius::cli
