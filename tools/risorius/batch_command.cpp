// SPDX-License-Identifier: MIT
// risorius batch DESIGN -o DIR
#include <cstdio>
#include <nlohmann/json.hpp>
#include <thread>

#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/core/known_names.h"
#include "risorius/stimuli/batch.h"
#include "risorius/stimuli/slurm.h"
#include "tools/risorius/commands.h"

namespace risorius::cli {

namespace {

struct BatchArguments {
    Common common;
    stimuli::BatchOptions options;
    std::string part;
    bool plan = false, list = false;
    std::string engine = "local";
    stimuli::SlurmOptions slurm;
};

std::string time_text(double seconds) {
    char text[48];
    if (seconds < 120)
        std::snprintf(text, sizeof text, "%.0f s", seconds);
    else if (seconds < 7200)
        std::snprintf(text, sizeof text, "%.0f min", seconds / 60);
    else
        std::snprintf(text, sizeof text, "%.1f h", seconds / 3600);
    return text;
}

Json balance_json(const std::string& set, const design::Balance& balance) {
    Json factors = Json::object();
    for (const auto& factor : balance.factors)
        factors[factor.name] = json_object({{"least", factor.min}, {"most", factor.max}});
    return json_object({{"set", set},
                        {"conditions", balance.used},
                        {"of", balance.all},
                        {"times_of_a_level", factors},
                        {"times_of_a_pair",
                         json_object({{"least", balance.pair_min}, {"most", balance.pair_max}})},
                        {"strength", balance.strength}});
}

void print_plan(const BatchArguments& arguments) {
    stimuli::BatchPlan plan;
    {
        ProgressBar bar(arguments.common);
        plan = stimuli::plan_batch(arguments.options.design, bar.monitor());
    }
    long frames = 0;
    for (const stimuli::ClipPlan& clip : plan.clips) frames += clip.frames;
    if (arguments.list && arguments.common.json) {
        Json names = Json::array();
        for (const stimuli::ClipPlan& clip : plan.clips) names.push_back(clip.condition.clip);
        std::printf("%s\n", json_text(names, 1).c_str());
    } else if (arguments.list) {
        for (const stimuli::ClipPlan& clip : plan.clips)
            std::printf("%s\n", clip.condition.clip.c_str());
    } else if (arguments.common.json) {
        Json clips = Json::array();
        for (const stimuli::ClipPlan& clip : plan.clips)
            clips.push_back(json_object({{"stim_id", clip.condition.clip},
                                         {"set", clip.condition.set},
                                         {"control", clip.condition.control.name()},
                                         {"frames", clip.frames},
                                         {"fps", clip.fps}}));
        Json samples = Json::array();
        for (const auto& [set, sample] : plan.samples)
            samples.push_back(json_object(
                {{"set", set},
                 {"trials", sample.trials},
                 {"units", sample.units},
                 {"times_of_a_unit", json_object({{"least", sample.least}, {"most", sample.most}})},
                 {"largest_correlation", sample.largest_correlation}}));
        Json parts = Json::array();
        for (const auto& [set, balance] : plan.balances)
            parts.push_back(balance_json(set, balance));
        std::printf("%s\n", json_text(json_object({{"name", plan.name},
                                                   {"parts_of_crossings", parts},
                                                   {"samples", samples},
                                                   {"clips", clips},
                                                   {"notes", plan.notes},
                                                   {"frames", frames},
                                                   {"seconds_about", plan.seconds()},
                                                   {"megabytes_about", plan.megabytes()}}),
                                      2)
                                .c_str());
    } else {
        std::printf("%s: %zu clips, %ld frames, about %s on two cores and %.*f MB\n",
                    plan.name.c_str(), plan.clips.size(), frames, time_text(plan.seconds()).c_str(),
                    plan.megabytes() < 10 ? 1 : 0, plan.megabytes());
        for (const auto& [set, sample] : plan.samples)
            std::printf("%s: %s\n", set.c_str(), sample.text().c_str());
        for (const auto& [set, balance] : plan.balances)
            std::printf("%s: %s\n", set.c_str(), balance.text().c_str());
        for (const std::string& note : plan.notes) std::printf("  note: %s\n", note.c_str());
    }
}

// Reads a part such as "2/8".
void read_part(const std::string& text, stimuli::BatchOptions& options) {
    char rest = 0;
    if (std::sscanf(text.c_str(), "%6d/%6d%c", &options.part, &options.parts, &rest) != 2 ||
        options.parts < 1 || options.part < 1 || options.part > options.parts)
        throw Error("--part", "which of how many, as 2/8", "\"" + text + "\"");
}

void run(BatchArguments& arguments) {
    stimuli::BatchOptions& options = arguments.options;
    if (arguments.plan || arguments.list) return print_plan(arguments);
    if (options.out.empty()) throw Error("--out", "the folder of the set", "none");
    if (options.workers < 1 || options.workers > 256)
        throw Error("--workers", "clips made at once, 1 to 256", std::to_string(options.workers));
    if (!arguments.part.empty()) read_part(arguments.part, options);
    index_of_name("--engine", arguments.engine, {"local", "slurm"});
    if (arguments.engine == "slurm") {
        if (!arguments.part.empty()) throw Error("--part", "--engine local beside it", "slurm");
        if (arguments.slurm.tasks < 1 || arguments.slurm.tasks > 10000)
            throw Error("--tasks", "tasks of the array, 1 to 10000",
                        std::to_string(arguments.slurm.tasks));
        arguments.slurm.part_command = [replace = options.replace](
                                           const std::filesystem::path& design,
                                           const std::filesystem::path& out, int workers,
                                           const std::string& part) {
            std::vector<std::string> words{std::filesystem::canonical("/proc/self/exe").string(),
                                           "batch",
                                           design.string(),
                                           "--out",
                                           out.string(),
                                           "--workers",
                                           std::to_string(workers),
                                           "--part",
                                           part,
                                           "--json"};
            if (replace) words.emplace_back("--replace");
            return words;
        };
        arguments.slurm.workers = options.workers;
    }
    if (arguments.common.json)
        options.report_clip = [](const std::string& clip, const std::string& state,
                                 const std::string& why) {
            Json event = json_object({{"event", state}, {"stim_id", clip}});
            if (!why.empty()) event["why"] = why;
            std::printf("%s\n", json_text(event).c_str());
            std::fflush(stdout);
        };
    stimuli::BatchReport report;
    {
        ProgressBar bar(arguments.common);
        report = arguments.engine == "slurm"
                     ? stimuli::make_batch_on_slurm(options, arguments.slurm, bar.monitor())
                     : stimuli::make_batch(options, bar.monitor());
    }
    if (arguments.common.json) {
        std::printf("%s\n", json_text(report.json()).c_str());
    } else if (!arguments.common.quiet) {
        std::printf("%s: %d clips made, %d kept, %zu failed, %s\n", options.out.string().c_str(),
                    report.made, report.kept, report.failed.size(),
                    time_text(report.seconds).c_str());
        for (const std::string& note : report.notes) std::printf("note: %s\n", note.c_str());
        for (const std::string& file : report.changed)
            std::printf("note: %s was changed and stays; the new one is %s.new\n", file.c_str(),
                        file.c_str());
        if (report.complete)
            std::printf("open %s\n", (options.out / "index.html").string().c_str());
        else if (report.unmeasured > 0)
            std::printf(
                "%d conditions of other parts are not rendered yet. Luminance can be matched when "
                "all "
                "are: then run the same command again\n",
                report.unmeasured);
        else if (report.elsewhere > 0)
            std::printf(
                "%d clips belong to other parts. Run the same command without --part to complete "
                "the set\n",
                report.elsewhere);
    }
    if (report.failed.empty()) return;
    for (const auto& [clip, why] : report.failed)
        std::fprintf(stderr, "failed: %s: %s\n", clip.c_str(), why.c_str());
    throw RunError(std::to_string(report.failed.size()) + " of the clips could not be made");
}

}  // namespace

void add_batch(CLI::App& app) {
    CLI::App* command = app.add_subcommand("batch", "Make all clips of a set of stimuli");
    auto arguments = std::make_shared<BatchArguments>();
    stimuli::BatchOptions& options = arguments->options;
    options.workers = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    command->add_option("DESIGN", options.design, "The design")->required();
    command->add_option("-o,--out", options.out,
                        "The folder of the set. Clips that are in it and have not changed are "
                        "kept, so an interrupted run can be continued");
    command->add_flag(
        "--plan", arguments->plan,
        "Only check the design and print the number of clips, and estimates of time and size");
    command->add_flag("--list", arguments->list, "Only print the names of the clips, one per line");
    command->add_flag(
        "--replace", options.replace,
        "Replace files of the set that were changed since they were made. Without it, "
        "a changed clip is an error, and a changed program or table stays: the new "
        "one is put beside it as NAME.new");
    command->add_option(
        "--norms", options.norms,
        "A table of ratings with participant, stimulus_id and answer, and scales such as valence: "
        "hit rates, confusion and agreement become part of the set");
    command->add_option("--workers", options.workers, "Clips made at once")->capture_default_str();
    command->add_option(
        "--part", arguments->part,
        "Make only this part of the clips, such as 2/8: for several machines that share a file "
        "system. When all parts are done, run once without --part to complete the set");
    constexpr const char* kCluster = "On a cluster";
    command
        ->add_option("--engine", arguments->engine,
                     "local, or slurm: a job array makes the clips, --workers at once in each "
                     "task. Tasks that fail are submitted again")
        ->capture_default_str()
        ->group(kCluster);
    command->add_option("--tasks", arguments->slurm.tasks, "Number of tasks of the job array")
        ->capture_default_str()
        ->group(kCluster);
    command
        ->add_option("--retries", arguments->slurm.retries,
                     "How often tasks with missing clips are submitted again")
        ->capture_default_str()
        ->check(CLI::Range(0, 100))
        ->group(kCluster);
    command->add_option("--account", arguments->slurm.account, "The option --account of sbatch")
        ->group(kCluster);
    command
        ->add_option("--partition", arguments->slurm.partition, "The option --partition of sbatch")
        ->group(kCluster);
    command->add_option("--time", arguments->slurm.time, "The option --time of sbatch")
        ->group(kCluster);
    add_common(*command, arguments->common);
    command->footer(
        "Example:\n  risorius batch samples/stimuli/design.json --plan\n"
        "  risorius batch samples/stimuli/design.json -o out/stimuli\n"
        "  risorius batch samples/stimuli/design.json -o out/stimuli --engine slurm --tasks 32 "
        "--time 1:00:00");
    command->callback([arguments] { run(*arguments); });
}

}  // namespace risorius::cli
