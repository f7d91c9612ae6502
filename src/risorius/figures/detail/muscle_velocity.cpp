// SPDX-License-Identifier: MIT
#include "risorius/figures/detail/muscle_velocity.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "risorius/figures/detail/line_muscle.h"
#include "risorius/figures/detail/muscle_release.h"
#include "risorius/figures/detail/muscle_runs.h"
#include "risorius/figures/detail/progress.h"
#include "risorius/muscle/published_tables.h"

namespace risorius::figures {
namespace {

constexpr double kMillimetres = 1e3;
constexpr int kLawPoints = 201;

struct ReleasePlan {
    std::vector<MuscleRun> runs;
    std::vector<double> speeds, loads_f0;
    ReleaseBench bench;

    std::size_t releases() const { return speeds.size() + loads_f0.size(); }
};

std::vector<double> read_numbers(const JsonCursor& experiment, std::string_view key, Range range) {
    std::vector<double> numbers;
    if (const auto list = experiment.find(key))
        for (const JsonCursor& one : list->items()) {
            numbers.push_back(one.number(range));
            if (numbers.back() == 0) one.fail("a number that is not 0");
            if (numbers.size() > 1 && !(numbers.back() > numbers[numbers.size() - 2]))
                one.fail("more than the number before it");
        }
    return numbers;
}

ReleasePlan read_releases(const JsonCursor& experiment) {
    allow_experiment_keys(experiment, {"muscle", "runs", "activation", "speeds", "loads_f0",
                                       "reach", "at_fibre_length", "steps"});
    ReleasePlan plan;
    plan.runs = read_muscle_runs(experiment);
    for (const MuscleRun& run : plan.runs) require_elastic_tendons(run);
    plan.speeds = read_numbers(experiment, "speeds", {-2, 2});
    plan.loads_f0 = read_numbers(experiment, "loads_f0", {1e-3, 0.95});
    if (plan.releases() == 0)
        throw Error(experiment.place(), "\"speeds\", \"loads_f0\" or both", "none of them");
    ReleaseBench& bench = plan.bench;
    if (const auto v = experiment.find("activation")) bench.activation = v->number({0.01, 1});
    if (const auto v = experiment.find("reach")) bench.reach = v->number({0.01, 0.5});
    if (const auto v = experiment.find("at_fibre_length"))
        bench.at_fibre_length = v->number({0.5, 1.5});
    if (const auto v = experiment.find("steps")) bench.steps = v->integer(10, 10000);
    return plan;
}

double law(const ReleasePlan& plan, const MuscleRun& run, double speed) {
    return line_moving_tension(run.muscle, plan.bench.at_fibre_length, speed,
                               plan.bench.activation);
}

/// The shortening releases of one run that reached the length.
struct Shortening {
    std::vector<double> force_f0, speed, power;
};

Shortening shortening_of(const std::vector<Passing>& passings) {
    Shortening found;
    for (const Passing& passing : passings) {
        if (!passing.found || passing.speed >= 0) continue;
        found.force_f0.push_back(passing.force_f0);
        found.speed.push_back(-passing.speed);
        found.power.push_back(-passing.speed * passing.force_f0);
    }
    return found;
}

void measure(const ReleasePlan& plan, const MuscleRun& run, const std::vector<Passing>& passings,
             Outcome& outcome) {
    Table table{.name = "releases_" + run.name,
                .columns = {"speed", "load_f0", "force_f0", "fibre_speed", "law_force_f0", "steps"},
                .rows = {}};
    double error = 0, missed = 0;
    constexpr double kMissed = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 0; i < passings.size(); ++i) {
        const Passing& passing = passings[i];
        const bool by_speed = i < plan.speeds.size();
        const double given = by_speed ? plan.speeds[i] : plan.loads_f0[i - plan.speeds.size()];
        const double force = passing.found ? passing.force_f0 : kMissed;
        const double speed = passing.found ? passing.speed : kMissed;
        const double expected = passing.found ? law(plan, run, passing.speed) : kMissed;
        const std::string of =
            "/" + run.name + (by_speed ? "/speed/" : "/load/") + format_number(given);
        outcome.measured.add("force_f0" + of, "F0", force);
        outcome.measured.add("fibre_speed" + of, "vmax", speed);
        table.rows.push_back({by_speed ? given : kMissed, by_speed ? kMissed : given, force, speed,
                              expected, static_cast<double>(passing.motion.steps)});
        if (passing.found)
            error = std::max(error, std::abs(passing.force_f0 - expected));
        else
            missed += 1;
    }
    outcome.figure.tables.push_back(std::move(table));
    outcome.measured.add("law_error_f0/" + run.name, "F0", error);
    outcome.measured.add("missed/" + run.name, "", missed);
    const Shortening found = shortening_of(passings);
    if (found.speed.size() < 2) return;
    const Hill hill = hill_through(found.force_f0, found.speed);
    const auto best =
        std::max_element(found.power.begin(), found.power.end()) - found.power.begin();
    outcome.measured.add("hill_a_f0/" + run.name, "F0", hill.a_f0);
    outcome.measured.add("hill_vmax/" + run.name, "vmax", hill.max_speed);
    outcome.measured.add("power/" + run.name, "F0 vmax l0",
                         found.power[static_cast<std::size_t>(best)]);
    outcome.measured.add("power_speed/" + run.name, "vmax",
                         found.speed[static_cast<std::size_t>(best)]);
}

/// Adds curves of a fl fv(v) + fp + b v for every run between two speeds; as force over speed, or speed over force.
void add_laws(const ReleasePlan& plan, double from, double to, bool over_force,
              plot::Chart& chart) {
    for (std::size_t r = 0; r < plan.runs.size(); ++r) {
        plot::Series series{.label = r == 0 ? "law of the fibres" : "",
                            .mark = plot::Mark::kDashed,
                            .colour = plan.runs.size() == 1 ? 1 : static_cast<int>(r)};
        for (int i = 0; i < kLawPoints; ++i) {
            const double speed = from + (to - from) * i / (kLawPoints - 1);
            const double force = law(plan, plan.runs[r], speed);
            series.x.push_back(over_force ? force : speed);
            series.y.push_back(over_force ? -speed : force);
        }
        chart.series.push_back(std::move(series));
    }
}

/// Published points between two speeds; as force over speed, or speed over force.
plot::Series published_points(double from, double to, bool over_force) {
    plot::Series series{.label = "Zajac/Delp table", .mark = plot::Mark::kPoints, .colour = 6};
    for (const auto& [speed, force] : muscle::published_velocity_force()) {
        if (speed < from || speed > to) continue;
        series.x.push_back(over_force ? force : speed);
        series.y.push_back(over_force ? -speed : force);
    }
    return series;
}

/// Chart of force over the speed of the fibres, with the law.
plot::Chart force_velocity(const ReleasePlan& plan,
                           const std::vector<std::vector<Passing>>& passings) {
    plot::Chart chart{
        .name = "force_velocity",
        .title = "Force of moving fibres at " + format_number(plan.bench.at_fibre_length) + " l0",
        .x = {.label = "speed of the fibres / vmax (lengthening > 0)"},
        .y = {.label = "tension / F0"}};
    for (std::size_t r = 0; r < plan.runs.size(); ++r) {
        plot::Series solid{
            .label = plan.runs[r].label, .mark = plot::Mark::kLine, .colour = static_cast<int>(r)};
        for (std::size_t i = 0; i < plan.speeds.size(); ++i) {
            const Passing& passing = passings[r][i];
            if (!passing.found) continue;
            solid.x.push_back(passing.speed);
            solid.y.push_back(passing.force_f0);
        }
        chart.series.push_back(std::move(solid));
    }
    const double from = std::min(-1.0, plan.speeds.front());
    const double to = std::max(0.0, plan.speeds.back());
    add_laws(plan, from, to, /*over_force=*/false, chart);
    chart.series.push_back(published_points(from, to, /*over_force=*/false));
    return chart;
}

plot::Chart load_velocity(const ReleasePlan& plan,
                          const std::vector<std::vector<Passing>>& passings) {
    plot::Chart chart{.name = "load_velocity",
                      .title = "Speed of shortening against a weight",
                      .x = {.label = "load / F0"},
                      .y = {.label = "speed of shortening / vmax"}};
    for (std::size_t r = 0; r < plan.runs.size(); ++r) {
        plot::Series solid{
            .label = plan.runs[r].label, .mark = plot::Mark::kLine, .colour = static_cast<int>(r)};
        for (std::size_t i = plan.speeds.size(); i < plan.releases(); ++i) {
            const Passing& passing = passings[r][i];
            if (!passing.found) continue;
            solid.x.push_back(passing.force_f0);
            solid.y.push_back(-passing.speed);
        }
        chart.series.push_back(std::move(solid));
    }
    add_laws(plan, -1, 0, /*over_force=*/true, chart);
    chart.series.push_back(published_points(-1, 0, /*over_force=*/true));
    return chart;
}

/// Chart of the displacement of the weights of the first run over time.
plot::Chart lift(const ReleasePlan& plan, const std::vector<Passing>& passings) {
    plot::Chart chart{.name = "lift",
                      .title = "Lift of weights: " + plan.runs.front().label,
                      .x = {.label = "time (s)"},
                      .y = {.label = "lift (mm)"}};
    for (std::size_t i = plan.speeds.size(); i < plan.releases(); ++i) {
        plot::Series series{.label = format_number(plan.loads_f0[i - plan.speeds.size()]) + " F0"};
        const std::vector<MuscleSample>& samples = passings[i].motion.samples;
        for (const MuscleSample& sample : samples) {
            series.x.push_back(sample.t_s);
            series.y.push_back(kMillimetres *
                               (samples.front().lengthening_m - sample.lengthening_m));
        }
        chart.series.push_back(std::move(series));
    }
    return chart;
}

}  // namespace

void run_muscle_velocity(const JsonCursor& experiment, const RunOptions& options,
                         Outcome& outcome) {
    const ReleasePlan plan = read_releases(experiment);
    std::vector<std::vector<Passing>> passings(plan.runs.size(),
                                               std::vector<Passing>(plan.releases()));
    const auto each = static_cast<int>(plan.releases());
    const int tasks = each * static_cast<int>(plan.runs.size());
    Progress progress(options, tasks);
    parallel_for(tasks, options.threads, [&](int task) {
        const auto r = static_cast<std::size_t>(task / each);
        const auto i = static_cast<std::size_t>(task % each);
        const softbody::MuscleDescription& muscle = plan.runs[r].muscle;
        passings[r][i] = i < plan.speeds.size()
                             ? released_at_speed(muscle, plan.bench, plan.speeds[i], options)
                             : released_with_load(muscle, plan.bench,
                                                  plan.loads_f0[i - plan.speeds.size()], options);
        progress.done(1, plan.runs[r].label);
    });

    for (std::size_t r = 0; r < plan.runs.size(); ++r)
        measure(plan, plan.runs[r], passings[r], outcome);
    if (!plan.speeds.empty()) outcome.figure.charts.push_back(force_velocity(plan, passings));
    if (!plan.loads_f0.empty()) {
        outcome.figure.charts.push_back(load_velocity(plan, passings));
        outcome.figure.charts.push_back(lift(plan, passings.front()));
    }
}

}  // namespace risorius::figures
