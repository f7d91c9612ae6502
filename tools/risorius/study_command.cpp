// SPDX-License-Identifier: MIT
// risorius study STUDY -o DIR
#include <cstdio>
#include <nlohmann/json.hpp>

#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/study/run_study.h"
#include "risorius/study/study_description.h"
#include "tools/risorius/commands.h"

namespace risorius::cli {

namespace {

struct StudyArguments {
    Common common;
    study::StudyOptions options;
    bool plan = false;
};

Json plan_of(const study::StudyDescription& study) {
    Json parameters = Json::array();
    for (const study::Parameter& parameter : study.parameters)
        parameters.push_back(json_object({{"name", parameter.name},
                                          {"varies", parameter.text()},
                                          {"numbers", parameter.numbers.size()},
                                          {"each", parameter.each}}));
    return json_object({{"name", study.name},
                        {"faces", study.runs()},
                        {"poses", study.poses.size()},
                        {"landmarks", study.landmarks.size()},
                        {"parameters", std::move(parameters)}});
}

void print_plan(const StudyArguments& arguments) {
    const study::StudyDescription study = study::check_study(arguments.options.study);
    if (arguments.common.json) {
        std::printf("%s\n", json_text(plan_of(study), 2).c_str());
        return;
    }
    if (arguments.common.quiet) return;
    std::printf("%s: %d faces, %zu poses, %zu landmarks\n", study.name.c_str(), study.runs(),
                study.poses.size(), study.landmarks.size());
    for (const study::Parameter& parameter : study.parameters)
        std::printf("  %-24s %s; numbers: %zu%s\n", parameter.name.c_str(),
                    parameter.text().c_str(), parameter.numbers.size(),
                    parameter.each ? ", each by itself" : "");
}

/// An index as text; "n/a" where the pose does not vary.
std::string index_text(const Json& estimate) {
    if (!estimate[0].is_number()) return "n/a";
    char text[80];
    std::snprintf(text, sizeof text, "%5.2f [%.2f, %.2f]", estimate[0].get<double>(),
                  estimate[1].get<double>(), estimate[2].get<double>());
    return text;
}

void print(const Json& results, const std::string& page) {
    for (const auto& [name, pose] : results["poses"].items()) {
        double moved = 0, away = 0;
        std::string most, least_sure;
        for (const auto& [landmark, spread] : pose["landmarks"].items()) {
            if (spread["rig_mm"].get<double>() >= moved) {
                moved = spread["rig_mm"];
                most = landmark;
            }
            if (spread["away_p95_mm"].get<double>() >= away) {
                away = spread["away_p95_mm"];
                least_sure = landmark;
            }
        }
        const Json& at = pose["landmarks"][most];
        std::printf(
            "%s: %s moves by %.2f mm, 5 to 95 %%: %.2f to %.2f mm; 95 %% of %s within %.2f mm\n",
            name.c_str(), most.c_str(), moved, at["p5_mm"].get<double>(),
            at["p95_mm"].get<double>(), least_sure.c_str(), away);
        if (!pose.contains("indices")) continue;
        std::printf("  %-24s %-22s %s\n", "", "first order", "total");
        for (const auto& [parameter, index] : pose["indices"].items())
            std::printf("  %-24s %-22s %s\n", parameter.c_str(), index_text(index["first"]).c_str(),
                        index_text(index["total"]).c_str());
    }
    if (results["unsettled"].get<long>() > 0)
        std::printf("%ld poses did not come to rest within the limit of iterations\n",
                    results["unsettled"].get<long>());
    std::printf("report: %s\n", page.c_str());
}

void run(const StudyArguments& arguments) {
    const study::StudyOptions& options = arguments.options;
    if (arguments.plan) return print_plan(arguments);
    if (options.out.empty()) throw Error("study", "--out", "none");
    check_threads(options.threads);
    Json results;
    {
        ProgressBar bar(arguments.common);
        results = study::run_study(options, bar.monitor());
    }
    if (arguments.common.json)
        std::printf("%s\n", json_text(results, 2).c_str());
    else if (!arguments.common.quiet)
        print(results, (options.out / "index.html").generic_string());
}

}  // namespace

void add_study(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "study", "Vary numbers of a rig, and find how far its face depends on each of them");
    auto arguments = std::make_shared<StudyArguments>();
    command
        ->add_option("STUDY", arguments->options.study,
                     "A study: which numbers of a rig are varied, and in which poses the landmarks "
                     "are measured (JSON, see docs/formats/study.md)")
        ->required();
    command->add_option("-o,--out", arguments->options.out,
                        "The folder to write: new, empty, or with earlier results, which are "
                        "replaced. It is written only when all is done");
    command->add_flag("--plan", arguments->plan,
                      "Check the study, print what varies and how many faces are made, and stop");
    add_threads(*command, arguments->options.threads, "The results are");
    add_common(*command, arguments->common);
    command->footer(
        "Writes index.html with charts, samples.tsv (a row for each face), displacements.tsv (face "
        "x pose x landmark),\nspread.tsv, indices.tsv (first-order and total Sobol indices with 95 "
        "% intervals) and results.json.\n\n"
        "Examples:\n  risorius study samples/study/study.json --plan\n"
        "  risorius study samples/study/study.json -o out/study");
    command->callback([arguments] { run(*arguments); });
}

}  // namespace risorius::cli
