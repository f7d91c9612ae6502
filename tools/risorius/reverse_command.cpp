// SPDX-License-Identifier: MIT
// risorius reverse TABLE RESPONSES... -o DIR
#include <cstdio>
#include <nlohmann/json.hpp>

#include "risorius/core/data_folder.h"
#include "risorius/core/error.h"
#include "risorius/core/json_text.h"
#include "risorius/stimuli/reverse.h"
#include "tools/risorius/commands.h"

namespace risorius::cli {

namespace {

struct ReverseArguments {
    Common common;
    stimuli::ReverseOptions options;
    std::string by;
    bool no_pictures = false;
};

void print(const Json& models, const std::filesystem::path& out) {
    for (const Json& model : models.at("answers")) {
        std::string found;
        for (const Json& unit : model.at("units"))
            if (unit.at("role") != "none")
                found += " " + unit.at("unit").get<std::string>() +
                         (unit.at("role") == "inhibits" ? " (inhibits)" : "");
        std::printf("%s: %d of %d trials,%s\n", model.at("answer").get<std::string>().c_str(),
                    model.at("given").get<int>(), model.at("trials").get<int>(),
                    found.empty() ? " no unit beyond chance" : found.c_str());
    }
    std::printf("open %s\n", (out / "index.html").string().c_str());
}

void run_reverse(ReverseArguments& arguments) {
    stimuli::ReverseOptions& options = arguments.options;
    options.by_participant = !arguments.by.empty();
    options.pictures = !arguments.no_pictures;
    if (options.rig.empty()) options.rig = data_folder() / "rigs/adult/rig.json";
    Json models;
    {
        ProgressBar bar(arguments.common);
        models = stimuli::reverse_correlation(options, bar.monitor());
    }
    if (arguments.common.json)
        std::printf("%s\n", json_text(models, 2).c_str());
    else if (!arguments.common.quiet)
        print(models, options.out);
}

}  // namespace

void add_reverse(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "reverse", "Compute expressions from the answers to random facial movements");
    auto arguments = std::make_shared<ReverseArguments>();
    stimuli::ReverseOptions& options = arguments->options;
    command
        ->add_option("TABLE", options.table,
                     "The random movements: sample.tsv of a set with \"sample\"")
        ->required();
    command
        ->add_option("RESPONSES", options.responses,
                     "Tables of answers, .tsv or .csv, with the columns stimulus_id (or trial), "
                     "response and participant, and intensity if it was rated. The data of the "
                     "experiment programs of a set are such tables")
        ->required();
    command
        ->add_option("-o,--out", options.out,
                     "The folder to write: model.tsv, model.json, index.html, and the resulting "
                     "expression of each answer: model_ANSWER.json, a script for risorius render, "
                     "with a video and a strip of pictures")
        ->required();
    command->add_flag("--no-pictures", arguments->no_pictures, "Do not render the expressions");
    command->add_option("--answer", options.answers,
                        "Make the model of this answer only; it may be given several times");
    command
        ->add_option("--by", arguments->by,
                     "participant: also tell in how many participants each unit is found")
        ->check(CLI::IsMember({"participant"}));
    command->add_option("--rig", options.rig,
                        "Rig of the scripts that are written. Default: the adult");
    command
        ->add_option("--permutations", options.classification.permutations,
                     "Number of permutations for the chance level")
        ->check(CLI::Range(100, 100000))
        ->capture_default_str();
    command
        ->add_option("--bootstraps", options.classification.bootstraps,
                     "Number of bootstrap samples for the 95 % intervals")
        ->check(CLI::Range(100, 100000))
        ->capture_default_str();
    command
        ->add_option("--seed", options.classification.seed,
                     "Seed of the permutations and the bootstrap samples")
        ->capture_default_str();
    add_common(*command, arguments->common);
    command->footer(
        "Example:\n  risorius reverse out/random/sample.tsv out/random/experiment/data/*.csv "
        "-o out/model\n  risorius render out/model/model_happy.json -o happy.mp4");
    command->callback([arguments] { run_reverse(*arguments); });
}

}  // namespace risorius::cli
