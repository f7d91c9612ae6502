// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/experiment_files.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/stimuli/detail/experiment_programs.h"

namespace risorius::stimuli {

namespace fs = std::filesystem;

namespace {

bool is_shown(const design::ExperimentOptions& experiment, const design::Condition& condition) {
    const bool control = condition.control.kind != design::ControlKind::kNone;
    return (experiment.controls || !control) &&
           (experiment.sets.empty() || std::find(experiment.sets.begin(), experiment.sets.end(),
                                                 condition.set) != experiment.sets.end());
}

/// The background of the screen, which is that of all clips.
std::string screen_colour(const BatchPlan& plan) {
    for (const ClipPlan& clip : plan.clips)
        if (is_shown(*plan.experiment, clip.condition)) {
            char text[8];
            std::snprintf(text, sizeof text, "#%02x%02x%02x", clip.background[0],
                          clip.background[1], clip.background[2]);
            return text;
        }
    return {};
}

std::string plain_text(const Json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number()) return format_number(value.get<double>());
    return value.is_null() ? "" : json_text(value);
}

/// The key of the right answer for a clip; empty when the design does not name one.
std::string correct_key(const design::ExperimentOptions& experiment,
                        const design::Condition& condition) {
    if (!experiment.correct) return {};
    // These do not show what the condition shows.
    const design::ControlKind kind = condition.control.kind;
    if (kind == design::ControlKind::kPhaseScrambled || kind == design::ControlKind::kKnockOut ||
        kind == design::ControlKind::kMondrian || kind == design::ControlKind::kChimeric)
        return {};
    if (kind == design::ControlKind::kNeutral) {
        for (const auto& [key, answer] : experiment.answers)
            if (answer == "neutral") return key;
        return {};
    }
    for (const auto& [name, value] : condition.values)
        if (name == *experiment.correct)
            for (const auto& [key, answer] : experiment.answers)
                if (answer == plain_text(value)) return key;
    return {};
}

/// A cell of a CSV file, RFC 4180.
std::string csv_cell(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
    return out + "\"";
}

/// conditions.csv: a row for each clip.
std::vector<Json> condition_rows(const BatchPlan& plan, const std::vector<Json>& records) {
    std::vector<std::string> names;
    for (const ClipPlan& clip : plan.clips)
        if (is_shown(*plan.experiment, clip.condition))
            for (const auto& [name, value] : clip.condition.values)
                if (name != "set" && std::find(names.begin(), names.end(), name) == names.end())
                    names.push_back(name);
    std::vector<Json> out;
    for (std::size_t i = 0; i < plan.clips.size(); ++i) {
        const ClipPlan& clip = plan.clips[i];
        if (!is_shown(*plan.experiment, clip.condition)) continue;
        Json row = json_object(
            {{"stim_id", clip.condition.clip},
             {"stim_file", clip_files(clip).video.filename().generic_string()},
             {"set", clip.condition.set},
             {"control", clip.condition.control.name()},
             {"frames", records[i].at("frames")},
             {"fps", records[i].at("fps")},
             {"audio_file",
              clip.sound ? "../stimuli/stim-" + clip.condition.clip + "_audio.wav" : std::string()},
             {"correct_key", correct_key(*plan.experiment, clip.condition)}});
        if (clip.clips.pictures()) row["shown_s"] = clip.clips.shown_s;
        for (const std::string& name : names) {
            const auto value =
                std::find_if(clip.condition.values.begin(), clip.condition.values.end(),
                             [&](const auto& one) { return one.first == name; });
            row["value_" + name] =
                value == clip.condition.values.end() ? "" : plain_text(value->second);
        }
        out.push_back(std::move(row));
    }
    return out;
}

std::string csv_table(const std::vector<Json>& rows) {
    std::string out;
    for (const auto& [name, value] : rows.front().items())
        out += (out.empty() ? "" : ",") + csv_cell(name);
    out += "\n";
    for (const Json& row : rows) {
        std::string line;
        for (const auto& [name, value] : row.items())
            line += (line.empty() ? "" : ",") + csv_cell(plain_text(value));
        out += line + "\n";
    }
    return out;
}

/// Throws Error when clips that are shown have different backgrounds: the screen around them can have only one.
void check_backgrounds(const BatchPlan& plan) {
    const ClipPlan* first = nullptr;
    for (const ClipPlan& clip : plan.clips) {
        if (!is_shown(*plan.experiment, clip.condition)) continue;
        if (!first) first = &clip;
        if (clip.background != first->background)
            throw Error(
                "experiment", "one background in all clips that are shown",
                "another one in " + clip.condition.clip + " than in " + first->condition.clip);
    }
}

}  // namespace

void check_experiment(BatchPlan& plan) {
    if (!plan.experiment) return;
    const design::ExperimentOptions& experiment = *plan.experiment;
    bool any = false, any_correct = false;
    std::vector<std::string> without;
    for (const ClipPlan& clip : plan.clips) {
        if (!is_shown(experiment, clip.condition)) continue;
        any = true;
        if (!correct_key(experiment, clip.condition).empty())
            any_correct = true;
        else if (experiment.correct && !clip.is_control())
            without.push_back(clip.condition.clip);
        if (clip.clips.ending != "mp4" && clip.clips.ending != "webm" && !clip.clips.pictures() &&
            std::find(experiment.programs.begin(), experiment.programs.end(), "jspsych") !=
                experiment.programs.end())
            throw Error("clips/ending", "mp4, webm or png, which browsers show, for jspsych",
                        clip.clips.ending);
    }
    check_backgrounds(plan);
    if (!any) throw Error("experiment", "at least one clip that is shown", "none");
    if (experiment.correct && !any_correct)
        throw Error("experiment/correct", "a parameter with values that are among the answers",
                    risorius::in_quotes(*experiment.correct));
    if (!without.empty())
        plan.notes.push_back("experiment: none of the answers is correct for " +
                             std::to_string(without.size()) + " of the clips shown, " +
                             without.front() + (without.size() > 1 ? " the first" : ""));
}

std::map<std::string, std::string> right_answers(const BatchPlan& plan) {
    std::map<std::string, std::string> out;
    if (!plan.experiment) return out;
    for (const ClipPlan& clip : plan.clips) {
        const std::string right = correct_key(*plan.experiment, clip.condition);
        for (const auto& [key, answer] : plan.experiment->answers)
            if (key == right) out[clip.condition.clip] = answer;
    }
    return out;
}

void write_experiment(const BatchPlan& plan, const std::vector<Json>& records,
                      const WriteFile& write_below) {
    const design::ExperimentOptions& experiment = *plan.experiment;
    const std::vector<Json> rows = condition_rows(plan, records);
    Json answers = Json::array();
    for (const auto& [key, answer] : experiment.answers)
        answers.push_back(json_object({{"key", key}, {"answer", answer}}));
    const Json settings = json_object({{"name", plan.name},
                                       {"clips", "../stimuli/"},
                                       {"question", experiment.question},
                                       {"answers", answers},
                                       {"repetitions", experiment.repetitions},
                                       {"fixation_s", experiment.fixation_s},
                                       {"answer_during", experiment.answer_during},
                                       {"pulse_ms", plan.pulse_ms},
                                       {"background", screen_colour(plan)}});
    const auto write = [&](const char* name, const std::string& text) {
        write_below(fs::path("experiment") / name, text);
    };
    write("conditions.csv", csv_table(rows));
    write("settings.json", json_text(settings, 2) + "\n");
    for (const std::string& program : experiment.programs) {
        if (program == "psychopy") write("experiment.py", psychopy_program());
        if (program == "jspsych")
            write("index.html", jspsych_page(plan.name, experiment.jspsych_from,
                                             json_text(settings, 1), json_text(Json(rows), 1)));
    }
}

}  // namespace risorius::stimuli
