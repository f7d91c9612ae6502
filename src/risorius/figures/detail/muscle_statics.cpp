// SPDX-License-Identifier: MIT
#include "risorius/figures/detail/muscle_statics.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "risorius/figures/detail/line_muscle.h"
#include "risorius/figures/detail/muscle_release.h"
#include "risorius/figures/detail/muscle_runs.h"
#include "risorius/figures/detail/progress.h"
#include "risorius/figures/detail/still_muscle.h"
#include "risorius/muscle/published_tables.h"

namespace risorius::figures {
namespace {

constexpr int kMaxLengths = 1000;

struct Picture {
    std::size_t run;
    double length, activation;
    std::string name, caption;
};

struct StaticsPlan {
    std::vector<MuscleRun> runs;
    std::vector<double> lengths;  ///< ascending
    double activation = 1, range_above_peak = 0.5;
    std::vector<Picture> pictures;
    std::string over;  ///< label of the axis over which the runs are charted; empty: no such chart
    std::vector<double> at;  ///< one per run
    std::optional<double> load_f0;
};

std::vector<double> read_lengths(const JsonCursor& json) {
    std::vector<double> lengths;
    if (json.is_object()) {
        json.allow_keys({"from", "to", "step"});
        const double from = json.at("from").number(kNormalisedLengths);
        const double to = json.at("to").number({from, kNormalisedLengths.max});
        const double step =
            json.at("step").number({(to - from) / kMaxLengths, kNormalisedLengths.max});
        // Lengths are computed from a counter, so that no rounding error accumulates.
        const int count = step > 0 ? static_cast<int>(std::floor((to - from) / step + 1e-9)) : 0;
        for (int i = 0; i <= count; ++i)
            lengths.push_back(std::round((from + i * step) * 1e9) / 1e9);
        return lengths;
    }
    for (const JsonCursor& one : json.items()) {
        lengths.push_back(one.number(kNormalisedLengths));
        if (lengths.size() > 1 && !(lengths.back() > lengths[lengths.size() - 2]))
            one.fail("more than the length before it");
    }
    if (lengths.empty()) json.fail("at least one length");
    return lengths;
}

StaticsPlan read_statics(const JsonCursor& experiment) {
    allow_experiment_keys(experiment, {"muscle", "runs", "lengths", "activation", "pictures",
                                       "range_above_peak", "over", "load_f0"});
    StaticsPlan plan;
    plan.runs = read_muscle_runs(experiment, {"at"});
    plan.lengths = read_lengths(experiment.at("lengths"));
    if (const auto v = experiment.find("activation")) plan.activation = v->number({0, 1});
    if (const auto v = experiment.find("range_above_peak"))
        plan.range_above_peak = v->number({0, 1});
    if (const auto v = experiment.find("load_f0")) {
        plan.load_f0 = v->number({1e-3, 0.95});
        for (const MuscleRun& run : plan.runs) require_elastic_tendons(run);
    }
    if (const auto v = experiment.find("over")) {
        plan.over = v->string();
        for (const MuscleRun& run : plan.runs) plan.at.push_back(run.json.at("at").number());
    }
    if (const auto list = experiment.find("pictures"))
        for (const JsonCursor& json : list->items()) {
            json.allow_keys({"run", "length", "activation", "picture", "caption"});
            std::vector<std::string_view> names;
            for (const MuscleRun& run : plan.runs) names.push_back(run.name);
            const std::string run = json.at("run").one_of(names);
            Picture picture{.run = static_cast<std::size_t>(
                                std::find(names.begin(), names.end(), run) - names.begin()),
                            .length = json.at("length").number(kNormalisedLengths),
                            .activation = json.at("activation").number({0, 1}),
                            .name = json.at("picture").string(),
                            .caption = json.at("caption").string()};
            plan.pictures.push_back(std::move(picture));
        }
    return plan;
}

struct StaticsResult {
    std::vector<Still> passive, active;  ///< one per length
    std::optional<Passing> lift;
};

struct StaticsResults {
    std::vector<StaticsResult> runs;
    std::vector<Shape> shapes;
};

StaticsResults solve_equilibria(const StaticsPlan& plan, const RunOptions& options) {
    StaticsResults results;
    results.runs.resize(plan.runs.size());
    results.shapes.resize(plan.pictures.size());
    std::vector<std::pair<std::string, std::function<void()>>> tasks;
    for (std::size_t r = 0; r < plan.runs.size(); ++r) {
        const softbody::MuscleDescription& muscle = plan.runs[r].muscle;
        StaticsResult& into = results.runs[r];
        tasks.emplace_back(plan.runs[r].label, [&] {
            into.active = still_over(muscle, plan.activation, plan.lengths, options);
        });
        tasks.emplace_back(plan.runs[r].label,
                           [&] { into.passive = still_over(muscle, 0, plan.lengths, options); });
        if (plan.load_f0)
            tasks.emplace_back(plan.runs[r].label, [&] {
                into.lift = released_with_load(muscle, {.activation = plan.activation},
                                               *plan.load_f0, options);
            });
    }
    for (std::size_t p = 0; p < plan.pictures.size(); ++p)
        tasks.emplace_back(plan.pictures[p].name, [&, p] {
            const Picture& picture = plan.pictures[p];
            StillMuscle muscle(plan.runs[picture.run].muscle, picture.activation);
            muscle.at(picture.length);
            results.shapes[p] = muscle.shape(picture.name, picture.caption);
        });
    Progress progress(options, static_cast<double>(tasks.size()));
    parallel_for(static_cast<int>(tasks.size()), options.threads, [&](int i) {
        const auto& [what, run] = tasks[static_cast<std::size_t>(i)];
        run();
        progress.done(1, what);
    });
    return results;
}

/// Tension over F0 at each length of the plan.
struct TensionCurves {
    std::vector<double> total, passive, active;

    void add(double with_activation, double without) {
        total.push_back(with_activation);
        passive.push_back(without);
        active.push_back(with_activation - without);
    }
};

TensionCurves line_curves(const StaticsPlan& plan, const MuscleRun& run) {
    TensionCurves line;
    for (const double length : plan.lengths)
        line.add(line_tension(run.muscle, length, plan.activation),
                 line_tension(run.muscle, length, 0));
    return line;
}

/// Maximum distance of total and passive tension from those of fibre and matrix in parallel, in series with the tendon.
double matrix_error(const StaticsPlan& plan, const MuscleRun& run, const TensionCurves& solid) {
    const double volume_m3 = StillMuscle(run.muscle, 0).rest_volume_m3();
    double worst = 0;
    for (std::size_t i = 0; i < plan.lengths.size(); ++i) {
        const auto off = [&](double tension, double activation) {
            return std::abs(tension - line_tension_in_matrix(run.muscle, volume_m3, plan.lengths[i],
                                                             activation));
        };
        worst = std::max({worst, off(solid.total[i], plan.activation), off(solid.passive[i], 0)});
    }
    return worst;
}

/// Measures a run and adds its table.
TensionCurves measure(const StaticsPlan& plan, const MuscleRun& run, const StaticsResult& result,
                      Outcome& outcome) {
    Table table{.name = "tension_" + run.name,
                .columns = {"length", "total_f0", "passive_f0", "active_f0", "line_total_f0",
                            "line_passive_f0", "line_active_f0", "fibre_length",
                            "volume_change_percent", "bulge", "segment_spread"},
                .rows = {}};
    TensionCurves solid;
    const TensionCurves line = line_curves(plan, run);
    double unconverged = 0, worst = 0;
    Measurements& measured = outcome.measured;
    for (std::size_t i = 0; i < plan.lengths.size(); ++i) {
        const Still &passive = result.passive[i], &active = result.active[i];
        solid.add(active.tension_f0, passive.tension_f0);
        worst = std::max(worst, std::abs(solid.active[i] - line.active[i]));
        unconverged += (passive.converged ? 0 : 1) + (active.converged ? 0 : 1);
        table.rows.push_back({plan.lengths[i], solid.total[i], solid.passive[i], solid.active[i],
                              line.total[i], line.passive[i], line.active[i], active.stretch,
                              active.volume_change_percent, active.bulge, active.spread});
        const std::string of = "/" + run.name + "/" + format_number(plan.lengths[i]);
        measured.add("total_f0" + of, "F0", solid.total[i]);
        measured.add("passive_f0" + of, "F0", solid.passive[i]);
        measured.add("active_f0" + of, "F0", solid.active[i]);
        measured.add("line_active_f0" + of, "F0", line.active[i]);
        measured.add("volume_change_percent" + of, "%", active.volume_change_percent);
        measured.add("bulge" + of, "", active.bulge);
        measured.add("segment_spread" + of, "", active.spread);
    }
    outcome.figure.tables.push_back(std::move(table));
    const TensionPeak peak = peak_of(plan.lengths, solid.active, plan.range_above_peak);
    measured.add("line_error_f0/" + run.name, "F0", worst);
    if (run.muscle.discretisation == softbody::Discretisation::kCells &&
        run.muscle.musculotendon.tendon == muscle::TendonModel::kElastic)
        measured.add("matrix_error_f0/" + run.name, "F0", matrix_error(plan, run, solid));
    measured.add("peak_f0/" + run.name, "F0", peak.force_f0);
    measured.add("peak_length/" + run.name, "", peak.length);
    measured.add("range/" + run.name, "l0", peak.range);
    if (result.lift) {
        unconverged += result.lift->found ? 0 : 1;
        measured.add("speed/" + run.name, "vmax l0", -result.lift->plate_speed);
    }
    measured.add("unconverged/" + run.name, "", unconverged);
    return solid;
}

constexpr const char* kLengthLabel = "(distance of the plates - tendon slack length) / l0";

/// Tabulated points within the lengths of the plan.
plot::Series points_of(const StaticsPlan& plan, const muscle::PublishedTable& table,
                       const std::string& label) {
    plot::Series points{.label = label, .mark = plot::Mark::kPoints, .colour = 6};
    for (const auto& [length, force] : table) {
        if (length < plan.lengths.front() || length > plan.lengths.back()) continue;
        points.x.push_back(length);
        points.y.push_back(force);
    }
    return points;
}

plot::Chart over_length(const StaticsPlan& plan, const MuscleRun& run, const TensionCurves& solid) {
    const TensionCurves line = line_curves(plan, run);
    const std::vector<double>& x = plan.lengths;
    plot::Chart chart{.name = "tension_" + run.name,
                      .title = "Tension over length: " + discretisation_of(run.muscle),
                      .x = {.label = kLengthLabel},
                      .y = {.label = "tension / F0"}};
    chart.series = {{"total", x, solid.total, plot::Mark::kLine, 0},
                    {"passive", x, solid.passive, plot::Mark::kLine, 1},
                    {"active = total - passive", x, solid.active, plot::Mark::kLine, 2},
                    {"1-D equilibrium", x, line.total, plot::Mark::kDashed, 3},
                    {"", x, line.passive, plot::Mark::kDashed, 3},
                    {"", x, line.active, plot::Mark::kDashed, 3},
                    points_of(plan, muscle::published_active_force(), "Zajac/Delp: active"),
                    points_of(plan, muscle::published_passive_force(), "Zajac/Delp: passive")};
    return chart;
}

plot::Chart differences(const StaticsPlan& plan, const std::vector<TensionCurves>& solids) {
    plot::Chart chart{.name = "from_line",
                      .title = "Active force of the solid minus that of the 1-D equilibrium",
                      .x = {.label = kLengthLabel},
                      .y = {.label = "difference / F0"},
                      .bands = {{"within 0.02 F0", -0.02, 0.02}}};
    for (std::size_t r = 0; r < plan.runs.size(); ++r) {
        const TensionCurves line = line_curves(plan, plan.runs[r]);
        plot::Series series{
            .label = plan.runs[r].label, .x = plan.lengths, .mark = plot::Mark::kLinePoints};
        for (std::size_t i = 0; i < plan.lengths.size(); ++i)
            series.y.push_back(solids[r].active[i] - line.active[i]);
        chart.series.push_back(std::move(series));
    }
    return chart;
}

/// Charts of the active forces of all runs, and of peak, range and speed over the varied parameter.
std::vector<plot::Chart> over_parameter(const StaticsPlan& plan,
                                        const std::vector<StaticsResult>& results,
                                        const std::vector<TensionCurves>& solids) {
    plot::Chart active{
        .name = "active",
        .title = "Active force over length: " + discretisation_of(plan.runs.front().muscle),
        .x = {.label = kLengthLabel},
        .y = {.label = "active force / F0"}};
    plot::Chart over{
        .name = "over_parameter",
        .title = "Peak force, range and speed: solid (points), 1-D equilibrium (lines)",
        .x = {.label = plan.over},
        .y = {.label = "ratio to the first"}};
    const std::string range_label =
        "range above " + format_number(plan.range_above_peak) + " of the peak";
    std::vector<plot::Series> solid{{.label = "peak force"}, {.label = range_label}};
    std::vector<plot::Series> line = solid;
    if (plan.load_f0) {
        solid.push_back({.label = "speed of a load of " + format_number(*plan.load_f0) + " F0"});
        line.push_back(solid.back());
    }
    const auto relative = [](plot::Series& series, double at, double value) {
        series.x.push_back(at);
        series.y.push_back(value);
    };
    for (std::size_t r = 0; r < plan.runs.size(); ++r) {
        const softbody::MuscleDescription& muscle = plan.runs[r].muscle;
        active.series.push_back(
            {.label = plan.runs[r].label, .x = plan.lengths, .y = solids[r].active});
        const TensionPeak found = peak_of(plan.lengths, solids[r].active, plan.range_above_peak);
        const TensionPeak law =
            peak_of(plan.lengths, line_curves(plan, plan.runs[r]).active, plan.range_above_peak);
        const double at = plan.at[r];
        relative(solid[0], at, found.force_f0);
        relative(line[0], at, law.force_f0);
        relative(solid[1], at, found.range);
        relative(line[1], at, law.range);
        if (!plan.load_f0) continue;
        relative(solid[2], at, -results[r].lift->plate_speed);
        relative(line[2], at, -line_load_speed(muscle, *plan.load_f0, 1, plan.activation));
    }
    for (std::size_t k = 0; k < solid.size(); ++k) {
        for (plot::Series* series : {&solid[k], &line[k]}) {
            const double first = series->y.front();
            for (double& value : series->y) value /= first;
            series->colour = static_cast<int>(k);
        }
        solid[k].mark = plot::Mark::kPoints;
        line[k].label = "";
        over.series.push_back(solid[k]);
        over.series.push_back(line[k]);
    }
    return {active, over};
}

}  // namespace

void run_muscle_statics(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome) {
    const StaticsPlan plan = read_statics(experiment);
    StaticsResults results = solve_equilibria(plan, options);
    outcome.figure.shapes = std::move(results.shapes);
    std::vector<TensionCurves> solids;
    for (std::size_t r = 0; r < plan.runs.size(); ++r)
        solids.push_back(measure(plan, plan.runs[r], results.runs[r], outcome));
    if (plan.lengths.size() < 2) return;

    std::vector<plot::Chart>& charts = outcome.figure.charts;
    if (plan.over.empty())
        for (std::size_t r = 0; r < plan.runs.size(); ++r)
            charts.push_back(over_length(plan, plan.runs[r], solids[r]));
    else
        charts = over_parameter(plan, results.runs, solids);
    charts.push_back(differences(plan, solids));
}

}  // namespace risorius::figures
