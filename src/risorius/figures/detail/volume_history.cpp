// SPDX-License-Identifier: MIT
#include "risorius/figures/detail/volume_history.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>

#include "risorius/core/json_text.h"
#include "risorius/figures/detail/body_cases.h"
#include "risorius/figures/detail/progress.h"

namespace risorius::figures {
namespace {

/// Number of colours in the palette of charts; further curves repeat the colours and are dashed.
constexpr std::size_t kColours = 8;

struct History {
    std::vector<double> volume_percent, sum_percent;  ///< one per sample, from t = 0
    solve::IntegratorReport report;
};
using Histories = std::vector<History>;

struct Times {
    double sample_s;
    int count;  ///< number of samples after t = 0
};

History record(const BodyRun& run, const Times& times, const RunOptions& options) {
    const softbody::SoftBody body = softbody::build_body(run.body);
    solve::IntegratorOptions integrator = run.integrator;
    integrator.length_scale_m = body.length_scale_m;
    const auto steps = solve::make_integrator(integrator);
    solve::MotionState state = body.start();
    body.system.place_fixed(0, state.x, state.v);

    History history;
    const double volume = body.volume(body.rest), sum = body.volume_element_sum(body.rest);
    for (int i = 0; i <= times.count; ++i) {
        options.monitor.throw_if_stopped();
        if (!history.report.diverged)
            history.report.add(steps->advance(body.system, state, i * times.sample_s));
        const bool lost = history.report.diverged;
        const double nothing = std::numeric_limits<double>::quiet_NaN();
        history.volume_percent.push_back(lost ? nothing
                                              : 100 * (body.volume(state.x) / volume - 1));
        history.sum_percent.push_back(lost ? nothing
                                           : 100 * (body.volume_element_sum(state.x) / sum - 1));
    }
    return history;
}

Histories record_all(const std::vector<BodyRun>& runs, const Times& times,
                     const RunOptions& options) {
    const Workload load = workload_of(runs);
    Histories histories(runs.size());
    Progress progress(options, load.whole);
    parallel_for(static_cast<int>(runs.size()), options.threads, [&](int i) {
        const std::size_t at = load.order[static_cast<std::size_t>(i)];
        histories[at] = record(runs[at], times, options);
        progress.done(load.work[at], runs[at].name + " " + grid_name(runs[at].body.grid));
    });
    return histories;
}

struct Features {
    double peak, peak_time_s, last, settled_s;
};

Features features_of(const std::vector<double>& percent, double sample_s) {
    Features features{0, 0, 0, 0};
    for (std::size_t i = 0; i < percent.size(); ++i) {
        if (std::isnan(percent[i])) {
            const double nothing = percent[i];
            return {nothing, nothing, nothing, nothing};
        }
        if (std::abs(percent[i]) > std::abs(features.peak)) {
            features.peak = percent[i];
            features.peak_time_s = static_cast<double>(i) * sample_s;
        }
    }
    const std::size_t tail = std::max<std::size_t>(1, percent.size() / 10);
    features.last = std::accumulate(percent.end() - static_cast<long>(tail), percent.end(), 0.0) /
                    static_cast<double>(tail);
    constexpr double kSettledFraction = 0.05;
    for (std::size_t i = 0; i < percent.size(); ++i)
        if (std::abs(percent[i] - features.last) > kSettledFraction * std::abs(features.peak))
            features.settled_s = static_cast<double>(i + 1) * sample_s;
    return features;
}

/// Adds a table with one column per run, and a chart of it.
void show(const std::vector<BodyRun>& runs, const Histories& histories, const Times& times,
          std::vector<double> History::*percent, const std::string& name,
          const std::string& quantity, bool charted, FigureResult& figure) {
    Table table{.name = name, .columns = {"time_s"}, .rows = {}};
    for (int i = 0; i <= times.count; ++i) table.rows.push_back({i * times.sample_s});
    std::vector<plot::Chart> charts;
    for (std::size_t k = 0; k < runs.size(); ++k) {
        const BodyRun& run = runs[k];
        const std::vector<double>& values = histories[k].*percent;
        table.columns.push_back(run.name + "_" + grid_name(run.body.grid) + "_percent");
        plot::Series series{.label = grid_name(run.body.grid), .x = {}, .y = values};
        for (std::size_t i = 0; i < values.size(); ++i) {
            table.rows[i].push_back(values[i]);
            series.x.push_back(static_cast<double>(i) * times.sample_s);
        }
        const bool next_run = k == 0 || runs[k - 1].name != run.name;
        if (next_run)
            charts.push_back({.name = name + "_" + run.name,
                              .title = "Change of " + quantity + ": " + run.label,
                              .x = {.label = "time (s)"},
                              .y = {.label = "change of " + quantity + " (%)"}});
        if (charts.back().series.size() >= kColours) series.mark = plot::Mark::kDashed;
        charts.back().series.push_back(std::move(series));
    }
    figure.tables.push_back(std::move(table));
    if (charted)
        for (plot::Chart& chart : charts) figure.charts.push_back(std::move(chart));
}

/// Measures the limit of the change of volume for ever finer grids, from each pair of grids of which one has half the spacing of the
/// other: an error that is proportional to the square of the spacing cancels in (4 fine - coarse) / 3.
void extrapolate(const std::vector<BodyRun>& runs, const Histories& histories, const Times& times,
                 Outcome& outcome) {
    for (std::size_t c = 0; c < runs.size(); ++c)
        for (std::size_t f = c + 1; f < runs.size(); ++f) {
            const auto coarse = runs[c].body.grid, fine = runs[f].body.grid;
            if (runs[c].name != runs[f].name || fine.m - 1 != 2 * (coarse.m - 1) ||
                fine.n - 1 != 2 * (coarse.n - 1) || fine.o - 1 != 2 * (coarse.o - 1))
                continue;
            const auto last = [&](std::size_t k) {
                return features_of(histories[k].volume_percent, times.sample_s).last;
            };
            outcome.measured.add("extrapolated_percent/" + runs[c].name + "/" + grid_name(coarse) +
                                     "-" + grid_name(fine),
                                 "%", (4 * last(f) - last(c)) / 3);
        }
}

}  // namespace

void run_volume_history(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome) {
    allow_experiment_keys(experiment, {"body", "runs", "duration_s", "sample_s", "shows"});
    const std::vector<BodyRun> runs = read_runs(experiment);
    const JsonCursor sample = experiment.at("sample_s");
    const double duration_s = experiment.at("duration_s").number({1e-6, 1e6});
    const Times times{.sample_s = sample.number({duration_s / 1e6, duration_s}),
                      .count = static_cast<int>(std::lround(duration_s / sample.number()))};
    const bool shows_volume =
        experiment.at("shows").one_of({"volume", "volume-element-sum"}) == "volume";

    // Other figures may need the same run.
    const std::function<Histories()> run = [&] { return record_all(runs, times, options); };
    std::string key = "volume-history";
    for (const char* part : {"body", "runs", "duration_s", "sample_s"})
        key += json_text(experiment.at(part).json());
    const std::shared_ptr<const Histories> histories =
        options.shared ? options.shared->get<Histories>(key, run)
                       : std::make_shared<const Histories>(run());

    show(runs, *histories, times, &History::volume_percent, "volume", "the volume V", shows_volume,
         outcome.figure);
    show(runs, *histories, times, &History::sum_percent, "volume_element_sum",
         "the sum of volume elements dV", !shows_volume, outcome.figure);
    for (std::size_t k = 0; k < runs.size(); ++k) {
        const std::string of = "/" + runs[k].name + "/" + grid_name(runs[k].body.grid);
        const auto add = [&](const std::string& prefix, const std::vector<double>& percent) {
            const Features features = features_of(percent, times.sample_s);
            outcome.measured.add(prefix + "peak_percent" + of, "%", features.peak);
            outcome.measured.add(prefix + "peak_time_s" + of, "s", features.peak_time_s);
            outcome.measured.add(prefix + "last_percent" + of, "%", features.last);
            outcome.measured.add(prefix + "settled_s" + of, "s", features.settled_s);
        };
        add("", (*histories)[k].volume_percent);
        add("sum_", (*histories)[k].sum_percent);
        outcome.measured.add("steps" + of, "", static_cast<double>((*histories)[k].report.steps));
    }
    extrapolate(runs, *histories, times, outcome);
}

}  // namespace risorius::figures
