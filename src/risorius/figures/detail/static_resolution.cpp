// SPDX-License-Identifier: MIT
#include "risorius/figures/detail/static_resolution.h"

#include <algorithm>
#include <cmath>

#include "risorius/figures/detail/body_cases.h"
#include "risorius/figures/detail/equilibrium_run.h"
#include "risorius/figures/detail/progress.h"

namespace risorius::figures {
namespace {

struct Result {
    EquilibriumRun equilibrium;
    Extent extent{};
    double volume_change_percent = 0;
};

double nodes_per_axis(const BodyRun& run) { return std::cbrt(run.body.grid.size()); }

plot::Chart chart_of(const std::vector<BodyRun>& runs, const std::vector<Result>& results,
                     plot::Chart chart, double (*value)(const Result&)) {
    chart.x = {.label = "nodes per axis"};
    for (std::size_t k = 0; k < runs.size(); ++k) {
        if (k == 0 || runs[k - 1].name != runs[k].name)
            chart.series.push_back(
                {.label = runs[k].label, .x = {}, .y = {}, .mark = plot::Mark::kLinePoints});
        chart.series.back().x.push_back(nodes_per_axis(runs[k]));
        chart.series.back().y.push_back(value(results[k]));
    }
    return chart;
}

}  // namespace

void run_static_resolution(const JsonCursor& experiment, const RunOptions& options,
                           Outcome& outcome) {
    allow_experiment_keys(experiment, {"body", "runs", "duration_s", "length_along"});
    const std::vector<BodyRun> runs = read_runs(experiment);
    const int axis = experiment.at("length_along").one_of({"a1", "a2", "a3"})[1] - '1';
    const double duration_s =
        experiment.has("duration_s") ? experiment.at("duration_s").number({0, kInfinity}) : 0;

    const Workload load = workload_of(runs);
    std::vector<Result> results(runs.size());
    Progress progress(options, load.whole);
    parallel_for(static_cast<int>(runs.size()), options.threads, [&](int i) {
        const std::size_t at = load.order[static_cast<std::size_t>(i)];
        const softbody::SoftBody body = softbody::build_body(runs[at].body);
        Result& result = results[at];
        result.equilibrium = run_to_equilibrium(body, runs[at].integrator, duration_s, options);
        result.extent = extent_along(body, result.equilibrium.x, axis);
        result.volume_change_percent =
            100 * (body.volume(result.equilibrium.x) / body.volume(body.rest) - 1);
        progress.done(load.work[at], runs[at].name + " " + grid_name(runs[at].body.grid));
    });

    Table table{.name = "rest_under_weight",
                .columns = {"nodes", "length_ratio", "drift_ratio", "volume_change_percent",
                            "force_ratio", "steps", "evaluations", "linear_solves"},
                .rows = {}};
    for (std::size_t k = 0; k < runs.size(); ++k) {
        const Result& result = results[k];
        const std::string of = runs[k].name + "/" + grid_name(runs[k].body.grid);
        const auto linear_solves = static_cast<double>(result.equilibrium.report.linear_solves);
        outcome.measured.add("length_ratio/" + of, "", result.extent.length_ratio);
        outcome.measured.add("drift_ratio/" + of, "", result.extent.drift_ratio);
        outcome.measured.add("volume_change_percent/" + of, "%", result.volume_change_percent);
        outcome.measured.add("force_ratio/" + of, "", result.equilibrium.force_ratio);
        outcome.measured.add("linear_solves/" + of, "", linear_solves);
        table.row_names.push_back(of);
        table.rows.push_back(
            {static_cast<double>(runs[k].body.grid.size()), result.extent.length_ratio,
             result.extent.drift_ratio, result.volume_change_percent,
             result.equilibrium.force_ratio, static_cast<double>(result.equilibrium.report.steps),
             static_cast<double>(result.equilibrium.report.evaluations), linear_solves});
    }
    for (std::size_t k = 0; k < runs.size();) {
        double min = kInfinity, max = 0;
        std::size_t end = k;
        for (; end < runs.size() && runs[end].name == runs[k].name; ++end) {
            min = std::min(min, results[end].extent.length_ratio);
            max = std::max(max, results[end].extent.length_ratio);
        }
        outcome.measured.add("length_spread_percent/" + runs[k].name, "%",
                             200 * (max - min) / (max + min));
        k = end;
    }
    outcome.figure.tables.push_back(std::move(table));

    FigureResult& figure = outcome.figure;
    figure.charts.push_back(chart_of(runs, results,
                                     {.name = "length",
                                      .title = "Length at rest under its weight",
                                      .x = {},
                                      .y = {.label = "length / rest length"}},
                                     [](const Result& r) { return r.extent.length_ratio; }));
    figure.charts.push_back(
        chart_of(runs, results,
                 {.name = "volume_change",
                  .title = "Change of volume at rest under its weight",
                  .x = {},
                  .y = {.label = "change of volume (%)", .logarithmic = true}},
                 [](const Result& r) { return std::abs(r.volume_change_percent); }));
    figure.charts.push_back(chart_of(runs, results,
                                     {.name = "drift",
                                      .title = "Sideways drift at rest under its weight",
                                      .x = {},
                                      .y = {.label = "drift / rest length (%)"}},
                                     [](const Result& r) { return 100 * r.extent.drift_ratio; }));
}

}  // namespace risorius::figures
