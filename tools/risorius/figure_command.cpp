// SPDX-License-Identifier: MIT
// risorius figure ID[,ID..]|all|EXPERIMENT.json -o DIR, risorius figure --list
#include <cstdio>
#include <nlohmann/json.hpp>

#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/figures/figure_page.h"
#include "risorius/figures/run_figure.h"
#include "tools/risorius/commands.h"

namespace risorius::cli {

namespace {

struct FigureArguments {
    Common common;
    figures::FigureOptions options;
    bool list = false;
};

/// A duration in words: "3 s", "4 min".
std::string about(double seconds) {
    if (seconds <= 0) return "";
    char text[32];
    if (seconds < 90)
        std::snprintf(text, sizeof text, "about %.0f s", seconds);
    else
        std::snprintf(text, sizeof text, "about %.0f min", seconds / 60);
    return text;
}

void list(const FigureArguments& arguments) {
    const auto entries = figures::list_figures(arguments.options.from);
    if (arguments.common.json) {
        Json report = Json::array();
        for (const figures::FigureEntry& entry : entries)
            report.push_back(json_object(
                {{"id", entry.id}, {"title", entry.title}, {"run_time_s", entry.run_time_s}}));
        std::printf("%s\n", json_text(report, 2).c_str());
        return;
    }
    if (arguments.common.quiet) return;
    for (const figures::FigureEntry& entry : entries)
        std::printf("%-10s %-60s %s\n", entry.id.c_str(), entry.title.c_str(),
                    about(entry.run_time_s).c_str());
}

void print_figure(const Json& figure) {
    int passed = 0, missed = 0;
    for (const Json& check : figure["checks"]) passed += check["passes"].get<bool>();
    for (const Json& claim : figure["claims"]) missed += claim["verdict"] == "missed";
    std::printf("%-10s %2d of %2d checks pass; %d of %d claims missed  %s\n",
                figure["id"].get<std::string>().c_str(), passed,
                static_cast<int>(figure["checks"].size()), missed,
                static_cast<int>(figure["claims"].size()),
                figure["title"].get<std::string>().c_str());
}

void run(const FigureArguments& arguments) {
    if (arguments.list) return list(arguments);
    const figures::FigureOptions& options = arguments.options;
    if (options.figure.empty()) throw Error("figure", "an id, all, a file or --list", "none");
    if (options.out.empty()) throw Error("figure", "--out", "none");
    check_threads(options.threads);
    figures::FigureReport report;
    {
        ProgressBar bar(arguments.common);
        report = figures::run_figures(options, bar.monitor());
    }
    const std::string page = (options.out / "index.html").generic_string();
    if (arguments.common.json) {
        std::printf("%s\n", json_text(report.results, 2).c_str());
    } else if (!arguments.common.quiet) {
        if (report.results.contains("figures"))
            for (const Json& figure : report.results["figures"]) print_figure(figure);
        else
            print_figure(report.results);
        std::printf("%s\n", page.c_str());
    }
    for (const figures::FailedCheck& failed : report.failed)
        std::fprintf(stderr, "risorius: %s\n", (failed.figure + ": " + failed.what).c_str());
    if (!report.failed.empty())
        throw RunError(std::to_string(report.failed.size()) +
                       (report.failed.size() == 1 ? " number lies" : " numbers lie") +
                       " outside of the accepted range, see " + page);
}

}  // namespace

void add_figure(CLI::App& app) {
    CLI::App* command = app.add_subcommand("figure",
                                           "Run the experiment behind a published figure, and "
                                           "compare its result with the published one");
    auto arguments = std::make_shared<FigureArguments>();
    command->add_option(
        "FIGURE", arguments->options.figure,
        "Ids of --list, separated by commas, as 8a,8b; all; or an experiment file (.json)");
    command->add_option(
        "-o,--out", arguments->options.out,
        "The folder to write: new, empty, or with earlier results, which are "
        "replaced. It is written only when all is done; if the run fails, earlier results stay");
    command->add_flag("--list", arguments->list, "Print ids, titles and estimated times");
    command->add_option(
        "--from", arguments->options.from,
        "Folder of the input files: in it, a folder for each id. Default: samples/figures");
    add_threads(*command, arguments->options.threads, "The results are");
    add_common(*command, arguments->common);
    command->footer(
        "Writes index.html (published and measured side by side), results.json, tables as CSV, "
        "charts as SVG and PNG\n"
        "with the gnuplot script that draws them, and pictures of the deformed objects. Exit code "
        "1 when a number\n"
        "lies outside of its accepted range; everything is written then, too.\n\n"
        "Examples:\n  risorius figure --list\n  risorius figure 9b -o out/9b\n"
        "  risorius figure all -o out/figures\n  risorius figure mine/experiment.json -o out/mine");
    command->callback([arguments] { run(*arguments); });
}

}  // namespace risorius::cli
