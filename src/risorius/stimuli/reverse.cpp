// SPDX-License-Identifier: MIT
#include "risorius/stimuli/reverse.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/core/known_names.h"
#include "risorius/core/output_set.h"
#include "risorius/design/conditions.h"
#include "risorius/design/table.h"
#include "risorius/report/html_writer.h"
#include "risorius/stimuli/detail/catalogue.h"
#include "risorius/stimuli/detail/model_pictures.h"

namespace risorius::stimuli {

namespace fs = std::filesystem;
using Role = UnitModel::Role;

namespace {

constexpr double kAfter_s = 0.2;  // shown after the last movement of a model
constexpr int kFps = 30;

const char* role_name(Role role) {
    return role == Role::kFacilitates ? "facilitates"
           : role == Role::kInhibits  ? "inhibits"
                                      : "none";
}

std::string without_prefix(const std::string& stimulus) {
    return stimulus.starts_with("stim-") ? stimulus.substr(5) : stimulus;
}

std::string text_of_cell(const JsonCursor& cell) {
    const Json& value = cell.json();
    const std::string text = value.is_string()   ? value.get<std::string>()
                             : value.is_number() ? format_number(value.get<double>())
                                                 : json_text(value);
    return text == kMissingCell ? "" : text;
}

/// A cell by any of several names of its column; empty when there is none.
std::string cell_of(const std::vector<design::Given>& row, const std::vector<std::string>& names) {
    for (const std::string& name : names)
        for (const design::Given& cell : row)
            if (cell.name == name) return text_of_cell(cell.value);
    return {};
}

/// The index of the trial that a stimulus shows, and of each number of a trial.
struct TrialIndex {
    std::map<std::string, int> of_stimulus, of_number;
};

TrialIndex index_of(const fs::path& table, const std::vector<design::Trial>& trials) {
    TrialIndex out;
    for (std::size_t i = 0; i < trials.size(); ++i)
        out.of_number[std::to_string(trials[i].number)] = static_cast<int>(i);
    for (const std::vector<design::Given>& row : design::read_table(table)) {
        const std::string stimulus = cell_of(row, {"stimulus_id", "stim_id"});
        if (!stimulus.empty())
            out.of_stimulus[without_prefix(stimulus)] = out.of_number.at(cell_of(row, {"trial"}));
    }
    return out;
}

/// Adds the answers of a table. `participants`: the names so far, in their order.
void add_answers(const fs::path& file, const TrialIndex& index, Observations& out) {
    for (const std::vector<design::Given>& row :
         design::read_table(file, design::ColumnNames::kAny)) {
        const std::string given = cell_of(row, {"response", "answer"});
        if (given.empty()) continue;
        const std::string place = design::row_place(row),
                          participant = cell_of(row, {"participant"}),
                          stimulus = without_prefix(cell_of(row, {"stimulus_id", "stim_id"}));
        Observations::Answer answer;
        answer.given = given;
        const auto& known = stimulus.empty() ? index.of_number : index.of_stimulus;
        const std::string key = stimulus.empty() ? cell_of(row, {"trial"}) : stimulus;
        const auto trial = known.find(key);
        if (trial == known.end())
            throw Error(place, "a stimulus_id, or without one a trial, of the sample",
                        key.empty() ? "none" : in_quotes(key));
        answer.trial = trial->second;
        for (const design::Given& cell : row)
            if (cell.name == "intensity" && !text_of_cell(cell.value).empty())
                answer.intensity = cell.value.number({-1e6, 1e6});
        const auto who = std::find(out.participants.begin(), out.participants.end(), participant);
        answer.participant = static_cast<int>(who - out.participants.begin());
        if (who == out.participants.end()) out.participants.push_back(participant);
        out.answers.push_back(std::move(answer));
    }
}

Observations of_participant(const Observations& all, int participant) {
    Observations out = all;
    std::erase_if(out.answers,
                  [&](const Observations::Answer& one) { return one.participant != participant; });
    return out;
}

/// The answers that were given, in alphabetical order.
std::vector<std::string> given_answers(const Observations& observations) {
    std::vector<std::string> out;
    for (const Observations::Answer& one : observations.answers) out.push_back(one.given);
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

Json json_of(const Estimate& estimate) {
    return json_object({{"value", estimate.value}, {"low", estimate.low}, {"high", estimate.high}});
}

Json json_of(const UnitModel& unit, bool by_participant) {
    Json out = json_object({{"unit", unit.unit},
                            {"role", role_name(unit.role)},
                            {"shown", unit.shown},
                            {"answered", unit.answered},
                            {"r", json_of(unit.r)},
                            {"weight", json_of(unit.weight)}});
    if (by_participant) out["found_in"] = unit.found_in;
    for (std::size_t k = 0; k < unit.parameters.size(); ++k) {
        const ParameterModel& one = unit.parameters[k];
        Json value = json_of(one.model);
        value["r"] = one.r;
        value["p"] = one.p;
        if (one.r_intensity) {
            value["r_intensity"] = *one.r_intensity;
            value["p_intensity"] = *one.p_intensity;
        }
        out["course"][design::course_parameters()[k]] = std::move(value);
    }
    return out;
}

std::string four_decimals(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4f", value);
    return text;
}

std::string table_of(const std::vector<AnswerModel>& models, bool by_participant) {
    std::string out =
        "answer\tunit\trole\tshown\tanswered\tr\tr_low\tr_high\tweight\tweight_low\tweight_high";
    if (by_participant) out += "\tfound_in";
    for (const std::string& name : design::course_parameters())
        for (const char* end : {"", "_low", "_high", "_p", "_r_intensity", "_p_intensity"})
            out += "\t" + name + end;
    out += "\n";
    for (const AnswerModel& model : models)
        for (const UnitModel& unit : model.units) {
            out += catalogue_cell(Json(model.answer)) + "\t" + unit.unit + "\t" +
                   role_name(unit.role) + "\t" + std::to_string(unit.shown) + "\t" +
                   std::to_string(unit.answered);
            for (const Estimate& one : {unit.r, unit.weight})
                for (const double value : {one.value, one.low, one.high})
                    out += "\t" + four_decimals(value);
            if (by_participant) out += "\t" + std::to_string(unit.found_in);
            for (std::size_t k = 0; k < design::course_parameters().size(); ++k) {
                if (unit.parameters.empty()) {
                    for (int i = 0; i < 6; ++i) out += std::string("\t") + kMissingCell;
                    continue;
                }
                const ParameterModel& one = unit.parameters[k];
                for (const double value : {one.model.value, one.model.low, one.model.high, one.p})
                    out += "\t" + four_decimals(value);
                for (const std::optional<double>& value : {one.r_intensity, one.p_intensity})
                    out += "\t" + (value ? four_decimals(*value) : std::string(kMissingCell));
            }
            out += "\n";
        }
    return out;
}

/// The expression of a model as a script; none when no unit facilitates the answer.
std::optional<Json> script_of(const AnswerModel& model, const std::string& rig, int which) {
    std::vector<design::UnitCourse> courses;
    double end = 0;
    for (const UnitModel& unit : model.units)
        if (unit.role == Role::kFacilitates) {
            courses.push_back(unit.course(which));
            end = std::max(end, courses.back().offset_latency_s);
        }
    if (courses.empty()) return {};
    const Json script =
        json_object({{"format", "risorius-script"}, {"version", 1}, {"rig", rig}, {"fps", kFps}});
    return design::with_units(script, courses, std::ceil(10 * (end + kAfter_s)) / 10, "model");
}

/// The files of an answer begin with this.
std::string stem_of(const AnswerModel& model) { return "model_" + design::clip_word(model.answer); }

bool has_expression(const AnswerModel& model) {
    return std::any_of(model.units.begin(), model.units.end(),
                       [](const UnitModel& unit) { return unit.role == Role::kFacilitates; });
}

std::string page_of(const std::vector<AnswerModel>& models, bool pictures) {
    report::HtmlWriter html;
    html.element("h1", "What each answer needs");
    html.element("p",
                 "Action units whose correlation with the answer is larger than chance, with "
                 "intervals of 95 %. The others are in model.tsv.");
    for (const AnswerModel& model : models) {
        html.element("h2", model.answer);
        html.element("p", "Given in " + std::to_string(model.given) + " of " +
                              std::to_string(model.trials) +
                              " trials. By chance the correlations of all units stay between " +
                              four_decimals(model.threshold_down) + " and " +
                              four_decimals(model.threshold_up) + ".");
        if (pictures && has_expression(model)) {
            html.element("video", "",
                         {{"src", stem_of(model) + ".mp4"}, {"controls", ""}, {"loop", ""}});
            html.open("p")
                .single("img", {{"src", stem_of(model) + ".png"},
                                {"alt", "The expression of " + model.answer +
                                            " over time, with both ends of its interval"}})
                .close();
        }
        html.open("table").open("tr");
        for (const char* head : {"unit", "role", "correlation", "weight", "amplitude", "onset, s",
                                 "peak, s", "offset, s"})
            html.element("th", head);
        html.close();
        for (const UnitModel& unit : model.units) {
            if (unit.role == Role::kNone) continue;
            const auto told = [](const Estimate& one) {
                return four_decimals(one.value) + " (" + four_decimals(one.low) + " to " +
                       four_decimals(one.high) + ")";
            };
            html.open("tr");
            html.element("td", unit.unit).element("td", role_name(unit.role));
            html.element("td", told(unit.r)).element("td", told(unit.weight));
            for (std::size_t k = 0; k < 4; ++k)
                html.element(
                    "td", told(unit.parameters[k].model) + (unit.parameters[k].tuned ? " *" : ""));
            html.close();
        }
        html.close();
    }
    html.element("p", "* matters for the answer (p < 0.05, corrected for the six parameters)");
    return report::html_page("Reverse correlation", html);
}

/// Counts the participants whose own answers give a unit the same role.
void count_participants(const Observations& all, const ClassificationOptions& options,
                        const ProgressMonitor& monitor, AnswerModel& model) {
    ClassificationOptions own = options;
    own.bootstraps = 0;
    for (std::size_t p = 0; p < all.participants.size(); ++p) {
        const AnswerModel of = classification_model(of_participant(all, static_cast<int>(p)),
                                                    model.answer, own, monitor);
        for (std::size_t u = 0; u < model.units.size(); ++u)
            model.units[u].found_in +=
                of.units[u].role == model.units[u].role && of.units[u].role != Role::kNone;
    }
}

/// Writes the expressions, and their pictures.
void write_scripts(const std::vector<AnswerModel>& models, const ReverseOptions& options,
                   OutputSet& outputs, const ProgressMonitor& monitor) {
    const fs::path &rig = options.rig, &out = options.out;
    std::map<std::string, std::string> taken;
    const std::string seen =
        rig.is_absolute() && out.is_relative()
            ? rig.generic_string()
            : fs::relative(fs::absolute(rig), fs::absolute(out)).generic_string();
    std::optional<ModelPictures> pictures;
    if (options.pictures) pictures.emplace(outputs, monitor);
    for (const AnswerModel& model : models) {
        const std::string word = design::clip_word(model.answer);
        const auto [other, is_new] = taken.emplace(word, model.answer);
        if (word.empty() || !is_new)
            throw Error(
                "responses", "answers with different letters and digits",
                in_quotes(model.answer) + (is_new ? "" : " and " + in_quotes(other->second)));
        for (const auto& [ending, which] :
             {std::pair{"", 0}, std::pair{"_low", -1}, std::pair{"_high", 1}})
            if (const auto script = script_of(model, seen, which))
                write_file(outputs.file(out / ("model_" + word + ending + ".json")),
                           json_text(*script, 1) + "\n");
        if (!pictures || !has_expression(model)) continue;
        const std::string near = fs::absolute(rig).generic_string();
        pictures->write({{"low", *script_of(model, near, -1)},
                         {"model", *script_of(model, near, 0)},
                         {"high", *script_of(model, near, 1)}},
                        1, out / ("model_" + word));
    }
}

}  // namespace

Observations read_observations(const ReverseOptions& options) {
    Observations out;
    out.trials = design::read_trials(options.table);
    for (const design::Trial& trial : out.trials)
        for (const design::UnitCourse& course : trial.units)
            if (std::find(out.units.begin(), out.units.end(), course.unit) == out.units.end())
                out.units.push_back(course.unit);
    std::sort(out.units.begin(), out.units.end(), [](const auto& a, const auto& b) {
        return std::pair(a.size() - (a.find('.') == std::string::npos ? 0 : 2), a) <
               std::pair(b.size() - (b.find('.') == std::string::npos ? 0 : 2), b);
    });
    const TrialIndex index = index_of(options.table, out.trials);
    for (const fs::path& file : options.responses) add_answers(file, index, out);
    if (out.answers.empty())
        throw Error(options.responses.front().string(), "answers in a column response or answer",
                    "none");
    std::stable_sort(out.answers.begin(), out.answers.end(),
                     [](const auto& a, const auto& b) { return a.participant < b.participant; });
    return out;
}

Json reverse_correlation(const ReverseOptions& options, const ProgressMonitor& monitor) {
    const Observations observations = read_observations(options);
    std::vector<std::string> answers = given_answers(observations);
    for (const std::string& wanted : options.answers)
        index_of_name(option_name("answer"), wanted, answers);
    if (!options.answers.empty()) answers = options.answers;
    std::vector<AnswerModel> models;
    for (const std::string& answer : answers) {
        monitor.report(static_cast<double>(models.size()) / static_cast<double>(answers.size()),
                       answer);
        models.push_back(
            classification_model(observations, answer, options.classification, monitor));
        if (options.by_participant)
            count_participants(observations, options.classification, monitor, models.back());
    }
    Json list = Json::array();
    for (const AnswerModel& model : models) {
        Json units = Json::array();
        for (const UnitModel& unit : model.units)
            units.push_back(json_of(unit, options.by_participant));
        list.push_back(json_object({{"answer", model.answer},
                                    {"trials", model.trials},
                                    {"given", model.given},
                                    {"threshold_up", model.threshold_up},
                                    {"threshold_down", model.threshold_down},
                                    {"units", std::move(units)}}));
    }
    const Json json = json_object({{"format", "risorius-reverse"},
                                   {"version", 1},
                                   {"trials_of_sample", observations.trials.size()},
                                   {"participants", observations.participants.size()},
                                   {"permutations", options.classification.permutations},
                                   {"bootstraps", options.classification.bootstraps},
                                   {"seed", options.classification.seed},
                                   {"answers", std::move(list)}});
    OutputSet outputs(options.out);
    write_file(outputs.file(options.out / "model.json"), json_text(json, 1) + "\n");
    write_file(outputs.file(options.out / "model.tsv"), table_of(models, options.by_participant));
    write_file(outputs.file(options.out / "index.html"), page_of(models, options.pictures));
    write_scripts(models, options, outputs, monitor);
    monitor.throw_if_stopped();
    outputs.commit();
    return json;
}

}  // namespace risorius::stimuli
