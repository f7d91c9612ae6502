// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/experiment_files.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>

#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/stimuli/detail/experiment_programs.h"
#include "risorius/stimuli/detail/expression_script.h"

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

/// The value of a parameter in a condition, as text; empty when it has none.
std::string text_of(const design::Condition& condition, const std::string& name) {
    for (const auto& [key, value] : condition.values)
        if (key == name) return plain_text(value);
    return {};
}

bool is_adaptive(const design::ExperimentOptions& experiment) {
    return experiment.method != design::ExperimentOptions::Method::kConstant;
}

/// The level of a clip for an adaptive method, and its series; empty for a clip that the method does not use.
std::string level_of(const design::ExperimentOptions& experiment, const ClipPlan& clip,
                     const Json& record) {
    if (clip.is_control() || correct_key(experiment, clip.condition).empty()) return {};
    if (experiment.over != "seen_share") return text_of(clip.condition, experiment.over);
    const Json& seen = record.at("motion").at("seen_mm");
    const Json& full = record.at("motion").at("full_mm");
    if (seen.is_null() || full.is_null() || !(full.get<double>() > 0)) return {};
    return format_number(seen.get<double>() / full.get<double>());
}

std::string series_of(const design::ExperimentOptions& experiment,
                      const design::Condition& condition) {
    std::string out;
    for (const std::string& name : experiment.series_by)
        out += (out.empty() ? "" : " ") + text_of(condition, name);
    return out.empty() ? "all" : out;
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
        Json row =
            json_object({{"stim_id", clip.condition.clip},
                         {"stim_file", file_in_stimuli(clip)},
                         {"set", clip.condition.set},
                         {"control", clip.condition.control.name()},
                         {"frames", records[i].at("frames")},
                         {"fps", records[i].at("fps")},
                         {"audio_file", clip.sound ? "../" + clip_files(clip).sound.generic_string()
                                                   : std::string()},
                         {"correct_key", correct_key(*plan.experiment, clip.condition)}});
        if (clip.clips.pictures()) row["shown_s"] = clip.clips.shown_s;
        if (is_adaptive(*plan.experiment)) {
            row["level"] = level_of(*plan.experiment, clip, records[i]);
            row["series"] = series_of(*plan.experiment, clip.condition);
        }
        for (const std::string& name : names) row["value_" + name] = text_of(clip.condition, name);
        out.push_back(std::move(row));
    }
    return out;
}

/// The rows with "codes", a list of [code, time in s], for a page that reads no table.
Json with_codes(const std::vector<Json>& rows, const BatchPlan& plan,
                const std::vector<Json>& records) {
    std::map<std::string, Json> codes;
    for (const Json& record : records) {
        Json& of = codes[record.at("stim_id").get<std::string>()] = Json::array();
        for (const Trigger& trigger : triggers_of(record, plan.codes))
            if (trigger.merged_into.empty())
                of.push_back(Json::array({trigger.code, trigger.time_s}));
    }
    Json out = Json::array();
    for (Json row : rows) {
        row["codes"] = codes.at(row.at("stim_id").get<std::string>());
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
                plan.place("experiment"), "one background in all clips that are shown",
                "another one in " + clip.condition.clip + " than in " + first->condition.clip);
    }
}

/// Throws Error when an adaptive method has no levels to choose from; adds a note when they are few.
void check_levels(BatchPlan& plan) {
    const design::ExperimentOptions& experiment = *plan.experiment;
    for (const std::string& name : experiment.series_by) {
        bool known = false;
        for (const ClipPlan& clip : plan.clips)
            known = known || !text_of(clip.condition, name).empty();
        if (!known)
            throw Error(plan.place("experiment/series_by"), "names of parameters",
                        risorius::in_quotes(name));
    }
    std::map<std::string, std::set<std::string>> levels;
    for (const ClipPlan& clip : plan.clips) {
        if (!is_shown(experiment, clip.condition) || clip.is_control() ||
            correct_key(experiment, clip.condition).empty())
            continue;
        if (experiment.over == "seen_share") {
            // A face at rest, and random movements, have no share.
            if (!clip.condition.units.empty() ||
                !expression_at_full_intensity(clip.condition.script))
                continue;
            // Which share is seen is known when the clips are there; each is a level until then.
            levels[series_of(experiment, clip.condition)].insert(clip.condition.clip);
            continue;
        }
        const std::string text = text_of(clip.condition, experiment.over);
        char* end = nullptr;
        const double number = std::strtod(text.c_str(), &end);
        if (text.empty() || *end != 0 || !(number > 0))
            throw Error(plan.place("experiment/over"),
                        "a parameter with numbers above 0 in all clips",
                        risorius::in_quotes(experiment.over) + ", " + risorius::in_quotes(text) +
                            " in " + clip.condition.clip);
        levels[series_of(experiment, clip.condition)].insert(text);
    }
    if (levels.empty())
        throw Error(plan.place("experiment/over"),
                    "expressions or units in the clips, for \"seen_share\"", "none");
    for (const auto& [series, of] : levels) {
        if (of.size() < 2)
            throw Error(plan.place("experiment/method"), "two levels at least in each series",
                        "one in " + risorius::in_quotes(series));
        if (of.size() < 8)
            plan.notes.push_back("experiment: the series " + risorius::in_quotes(series) + " has " +
                                 std::to_string(of.size()) +
                                 " levels; a method that looks for a threshold wants 8 to 20");
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
            std::any_of(experiment.programs.begin(), experiment.programs.end(),
                        [](const std::string& one) { return one != "psychopy"; }))
            throw Error(plan.place("clips/ending"),
                        "mp4, webm or png, which browsers show, for jspsych and rating",
                        clip.clips.ending);
    }
    check_backgrounds(plan);
    if (!any) throw Error(plan.place("experiment"), "at least one clip that is shown", "none");
    if (experiment.correct && !any_correct)
        throw Error(plan.place("experiment/correct"),
                    "a parameter with values that are among the answers",
                    risorius::in_quotes(*experiment.correct));
    if (is_adaptive(experiment)) check_levels(plan);
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
    const std::string& method = design::method_names()[static_cast<std::size_t>(experiment.method)];
    const design::TriggerOptions& triggers = plan.triggers;
    const Json settings = json_object({{"name", plan.name},
                                       {"clips", "../stimuli/"},
                                       {"question", experiment.question},
                                       {"answers", answers},
                                       {"repetitions", experiment.repetitions},
                                       {"fixation_s", experiment.fixation_s},
                                       {"answer_during", experiment.answer_during},
                                       {"blocks", experiment.blocks},
                                       {"practice", experiment.practice},
                                       {"catch", experiment.catch_share},
                                       {"method", method},
                                       {"trials", experiment.trials},
                                       {"scales", experiment.scales},
                                       {"pulse_ms", triggers.pulse_ms},
                                       {"response", triggers.response},
                                       {"lsl", triggers.lsl},
                                       {"wait_for", triggers.wait_for},
                                       {"dummy_volumes", triggers.dummy_volumes},
                                       {"background", screen_colour(plan)}});
    const auto write = [&](const char* name, const std::string& text) {
        write_below(fs::path("experiment") / name, text);
    };
    write("conditions.csv", csv_table(rows));
    write("settings.json", json_text(settings, 2) + "\n");
    for (const std::string& program : experiment.programs) {
        if (program == "psychopy") write("experiment.py", psychopy_program());
        if (program == "jspsych")
            write("index.html",
                  jspsych_page(plan.name, experiment.jspsych_from, json_text(settings, 1),
                               json_text(with_codes(rows, plan, records), 1)));
        if (program == "rating")
            write("rating.html", rating_page(plan.name, experiment.jspsych_from,
                                             json_text(settings, 1), json_text(Json(rows), 1)));
    }
}

}  // namespace risorius::stimuli
