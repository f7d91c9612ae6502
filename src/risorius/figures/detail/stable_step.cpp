// SPDX-License-Identifier: MIT
#include "risorius/figures/detail/stable_step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "risorius/core/json_object.h"
#include "risorius/figures/detail/body_cases.h"
#include "risorius/figures/detail/linear_modes.h"
#include "risorius/figures/detail/progress.h"
#include "risorius/figures/detail/step_search.h"

namespace risorius::figures {
namespace {

/// Ratio of the divergence limit to the smallest excitation of a mode: linear theory lets a motion grow by this factor.
constexpr double kGrowthToDivergence = 1e6;

struct Sweep {
    std::vector<solve::Method> methods;
    std::string name, unit;
    std::vector<double> values;
    std::vector<softbody::BodyDescription> bodies;  ///< one per value
    StepSearch search;
};

/// Whether there is a value at `pointer`, or an object that can have it.
bool is_within(const Json::json_pointer& pointer, const Json& body) {
    if (pointer.empty()) return false;
    try {
        if (body.contains(pointer)) return true;
        const Json::json_pointer parent = pointer.parent_pointer();
        return body.contains(parent) && body.at(parent).is_object();
    } catch (const Json::exception&) {  // an index that is no number
        return false;
    }
}

Sweep read_sweep(const JsonCursor& experiment) {
    Sweep sweep;
    sweep.methods = read_fixed_step_methods(experiment.at("methods"));

    const JsonCursor varied = experiment.at("varied");
    varied.allow_keys({"name", "unit", "pointer", "values"});
    sweep.name = varied.at("name").string();
    sweep.unit = varied.at("unit").string();
    const JsonCursor pointer_json = varied.at("pointer");
    Json::json_pointer pointer;
    try {
        pointer = Json::json_pointer(pointer_json.string());
    } catch (const Json::exception&) {
        pointer_json.fail("a JSON pointer within the body");
    }
    for (const JsonCursor& value : varied.at("values").items()) {
        sweep.values.push_back(value.number());
        Json body = experiment.at("body").json();
        if (!is_within(pointer, body)) pointer_json.fail("a JSON pointer within the body");
        body[pointer] = value.json();
        const std::string file = experiment.file().string() + " (" + sweep.name + " = " +
                                 format_number(value.number()) + ")";
        sweep.bodies.push_back(softbody::read_body(
            JsonCursor::from_json(json_object({{"body", body}}), file).at("body")));
    }
    if (sweep.values.empty()) varied.at("values").fail("at least one value");

    sweep.search.steps_s = read_step_table(experiment.at("steps"));
    sweep.search.duration_s = experiment.at("duration_s").number({1e-9, 1e6});
    if (const auto diverged = experiment.find("diverged_at"))
        sweep.search.diverged_at = diverged->number({1e-3, 1e12});
    return sweep;
}

struct Found {
    StableStep stable;
    double predicted_s = 0;  ///< 0: no step of the table is stable
};

void show(const Sweep& sweep, const std::vector<Found>& found, Outcome& outcome) {
    const std::size_t methods = sweep.methods.size();
    const std::string axis = sweep.name + " (" + sweep.unit + ")";
    Table steps{.name = "longest_stable_step", .columns = {sweep.name}, .rows = {}};
    Table predicted{.name = "longest_step_of_linear_theory", .columns = {sweep.name}, .rows = {}};
    Table cost{.name = "evaluations", .columns = {sweep.name}, .rows = {}};
    plot::Chart chart{.name = "stable_step",
                      .title = "Longest stable step; dashed: linear theory about the rest state",
                      .x = {.label = "time step h (s)", .logarithmic = true},
                      .y = {.label = axis, .logarithmic = true}};
    for (std::size_t m = 0; m < methods; ++m) {
        const std::string name{solve::name_of(sweep.methods[m])};
        for (Table* table : {&steps, &predicted}) table->columns.push_back(name + "_s");
        cost.columns.push_back(name);
        plot::Series measured{.label = label_of(sweep.methods[m]),
                              .x = {},
                              .y = {},
                              .mark = plot::Mark::kLinePoints,
                              .colour = static_cast<int>(m)};
        plot::Series theory{.label = "",
                            .x = {},
                            .y = {},
                            .mark = plot::Mark::kDashed,
                            .colour = static_cast<int>(m)};
        for (std::size_t v = 0; v < sweep.values.size(); ++v) {
            const Found& one = found[v * methods + m];
            const std::string of = "/" + name + "/" + format_number(sweep.values[v]);
            outcome.measured.add("step_s" + of, "s", one.stable.step_s);
            outcome.measured.add("predicted_s" + of, "s", one.predicted_s);
            if (one.predicted_s > 0)
                outcome.measured.add("ratio" + of, "", one.stable.step_s / one.predicted_s);
            const auto mark = [&](plot::Series& series, double step_s) {
                if (!(step_s > 0)) return;
                series.x.push_back(step_s);
                series.y.push_back(sweep.values[v]);
            };
            mark(measured, one.stable.step_s);
            mark(theory, one.predicted_s);
        }
        chart.series.push_back(std::move(measured));
        chart.series.push_back(std::move(theory));
    }
    for (std::size_t v = 0; v < sweep.values.size(); ++v) {
        for (Table* table : {&steps, &predicted, &cost}) table->rows.push_back({sweep.values[v]});
        for (std::size_t m = 0; m < methods; ++m) {
            const Found& one = found[v * methods + m];
            steps.rows.back().push_back(one.stable.step_s);
            predicted.rows.back().push_back(one.predicted_s);
            cost.rows.back().push_back(static_cast<double>(one.stable.evaluations));
        }
    }
    for (Table* table : {&steps, &predicted, &cost})
        outcome.figure.tables.push_back(std::move(*table));
    outcome.figure.charts.push_back(std::move(chart));
}

}  // namespace

void run_stable_step(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome) {
    allow_experiment_keys(experiment,
                          {"body", "methods", "varied", "steps", "duration_s", "diverged_at"});
    const Sweep sweep = read_sweep(experiment);
    const std::size_t methods = sweep.methods.size(), values = sweep.values.size();

    std::vector<Found> found(values * methods);
    Progress progress(options, static_cast<double>(values * methods));
    parallel_for(static_cast<int>(values * methods), options.threads, [&](int i) {
        const std::size_t v = static_cast<std::size_t>(i) / methods;
        const std::size_t m = static_cast<std::size_t>(i) % methods;
        const softbody::SoftBody body = softbody::build_body(sweep.bodies[v]);
        found[static_cast<std::size_t>(i)].stable =
            longest_stable_step(body, sweep.methods[m], sweep.search, options);
        progress.done(1, std::string(solve::name_of(sweep.methods[m])) + " at " + sweep.name +
                             " = " + format_number(sweep.values[v]));
    });

    // Searches the same table by linear theory.
    parallel_for(static_cast<int>(values), options.threads, [&](int i) {
        const std::size_t v = static_cast<std::size_t>(i);
        const softbody::SoftBody body = softbody::build_body(sweep.bodies[v]);
        const auto lambdas = small_motions(body, body.rest);
        for (std::size_t m = 0; m < methods; ++m)
            for (const double step_s : sweep.search.steps_s)
                if (stays_bounded(sweep.methods[m], lambdas, step_s, sweep.search.duration_s,
                                  kGrowthToDivergence)) {
                    found[v * methods + m].predicted_s = step_s;
                    break;
                }
    });
    show(sweep, found, outcome);
}

}  // namespace risorius::figures
