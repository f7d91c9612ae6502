// SPDX-License-Identifier: MIT
#include "risorius/figures/detail/muscle_history.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "risorius/figures/detail/muscle_drive.h"
#include "risorius/figures/detail/muscle_motion.h"
#include "risorius/figures/detail/muscle_runs.h"
#include "risorius/figures/detail/progress.h"

namespace risorius::figures {
namespace {

constexpr double kNever = std::numeric_limits<double>::quiet_NaN();

struct Quantity {
    std::string_view name;
    const char* column;  ///< name of the column in tables, after the name of the run
    const char* label;   ///< label of the axis
    double (*of)(const MuscleSample& sample);
};

constexpr Quantity kQuantities[] = {
    {"tension", "tension_f0", "tension / F0", [](const MuscleSample& s) { return s.tension_f0; }},
    {"activation", "activation", "activation", [](const MuscleSample& s) { return s.activation; }},
    {"fibre-length", "fibre_length", "fibre length / l0",
     [](const MuscleSample& s) { return s.stretch; }},
    {"volume", "volume_change_percent", "change of volume (%)",
     [](const MuscleSample& s) { return 100 * (s.volume_ratio - 1); }},
};

struct Shown {
    const Quantity* quantity;
    std::string name, title;
    double from_s = 0, to_s = 0;
};

struct HistoryRun {
    MuscleRun muscle;
    plot::Mark mark = plot::Mark::kLine;
    Drive drive;
    std::function<double(double t_s)> length;
};

struct HistoryPlan {
    std::vector<Phase> phases;
    std::vector<HistoryRun> runs;
    std::optional<double> release_s;
    std::vector<Shown> shown;

    double end_s() const { return phases.back().until_s; }
};

/// The value of the run, or else that of the experiment.
JsonCursor own_or_common(const JsonCursor& run, const JsonCursor& experiment,
                         std::string_view key) {
    const auto own = run.find(key);
    return own ? *own : experiment.at(key);
}

HistoryPlan read_history(const JsonCursor& experiment) {
    allow_experiment_keys(experiment,
                          {"muscle", "runs", "phases", "drive", "length", "release_s", "shows"});
    HistoryPlan plan;
    plan.phases = read_phases(experiment.at("phases"));
    for (MuscleRun& muscle : read_muscle_runs(experiment, {"drive", "length", "mark"})) {
        require_elastic_tendons(muscle);
        const JsonCursor& json = muscle.json;
        Drive drive = read_drive(own_or_common(json, experiment, "drive"), plan.end_s());
        auto length = read_course(own_or_common(json, experiment, "length"), kNormalisedLengths);
        const bool dashed =
            json.has("mark") && json.at("mark").one_of({"line", "dashed"}) == "dashed";
        plan.runs.push_back({std::move(muscle), dashed ? plot::Mark::kDashed : plot::Mark::kLine,
                             std::move(drive), std::move(length)});
    }
    if (const auto v = experiment.find("release_s")) plan.release_s = v->number({0, plan.end_s()});
    for (const JsonCursor& json : experiment.at("shows").items()) {
        json.allow_keys({"quantity", "name", "title", "from_s", "to_s"});
        std::vector<std::string_view> names;
        for (const Quantity& quantity : kQuantities) names.push_back(quantity.name);
        const std::string name = json.at("quantity").one_of(names);
        Shown shown{.quantity = std::find_if(std::begin(kQuantities), std::end(kQuantities),
                                             [&](const Quantity& q) { return q.name == name; }),
                    .name = json.has("name") ? json.at("name").string() : name,
                    .title = json.at("title").string(),
                    .to_s = plan.end_s()};
        if (const auto v = json.find("from_s")) shown.from_s = v->number({0, plan.end_s()});
        if (const auto v = json.find("to_s")) shown.to_s = v->number({shown.from_s, plan.end_s()});
        plan.shown.push_back(std::move(shown));
    }
    return plan;
}

/// Time after sample `from` at which tension rises above (or falls below) a height, interpolated between samples, s.
double time_of(const std::vector<MuscleSample>& samples, std::size_t from, double height,
               bool rising) {
    for (std::size_t i = from + 1; i < samples.size(); ++i) {
        const double before = samples[i - 1].tension_f0, now = samples[i].tension_f0;
        if (rising ? now < height || before >= height : now > height || before <= height) continue;
        return samples[i - 1].t_s +
               (samples[i].t_s - samples[i - 1].t_s) * (height - before) / (now - before);
    }
    return kNever;
}

/// Time after the sample `from` until a quantity has fallen to half of what it is there, interpolated between samples, s.
double time_until_half(const std::vector<MuscleSample>& samples, std::size_t from,
                       double MuscleSample::*quantity) {
    const double height = samples[from].*quantity / 2;
    for (std::size_t i = from + 1; i < samples.size(); ++i) {
        const double before = samples[i - 1].*quantity, now = samples[i].*quantity;
        if (now > height) continue;
        return samples[i - 1].t_s - samples[from].t_s +
               (samples[i].t_s - samples[i - 1].t_s) * (height - before) / (now - before);
    }
    return kNever;
}

bool weaker(const MuscleSample& a, const MuscleSample& b) { return a.tension_f0 < b.tension_f0; }

void measure_release(const std::vector<MuscleSample>& samples, double release_s,
                     const std::string& of, Measurements& measured) {
    std::size_t at = 0;
    while (at + 1 < samples.size() && samples[at + 1].t_s <= release_s * (1 + 1e-12)) ++at;
    const auto min = static_cast<std::size_t>(
        std::min_element(samples.begin() + static_cast<long>(at), samples.end(), weaker) -
        samples.begin());
    const double final_f0 = samples.back().tension_f0;
    measured.add("before_f0" + of, "F0", samples[at].tension_f0);
    measured.add("least_f0" + of, "F0", samples[min].tension_f0);
    const auto back_s = [&](double fraction) {
        return time_of(samples, min, fraction * final_f0, /*rising=*/true) - release_s;
    };
    measured.add("t50_s" + of, "s", back_s(0.5));
    measured.add("t90_s" + of, "s", back_s(0.9));
}

void measure_pulses(const std::vector<MuscleSample>& samples, const Pulses& pulses,
                    const std::string& of, Measurements& measured) {
    const auto peak = static_cast<std::size_t>(
        std::max_element(samples.begin(), samples.end(), weaker) - samples.begin());
    measured.add("contraction_s" + of, "s", samples[peak].t_s - pulses.first_s);
    measured.add(
        "half_relaxation_s" + of, "s",
        time_of(samples, peak, samples[peak].tension_f0 / 2, /*rising=*/false) - samples[peak].t_s);
    const auto most =
        static_cast<std::size_t>(std::max_element(samples.begin(), samples.end(),
                                                  [](const MuscleSample& a, const MuscleSample& b) {
                                                      return a.activation < b.activation;
                                                  }) -
                                 samples.begin());
    measured.add("peak_activation" + of, "", samples[most].activation);
    measured.add("activation_half_s" + of, "s",
                 time_until_half(samples, most, &MuscleSample::activation));
    if (pulses.count < 2) return;
    // Between the last two pulses
    const double from_s = pulses.start_s(pulses.count - 2), to_s = pulses.start_s(pulses.count - 1);
    double min = std::numeric_limits<double>::infinity(), max = 0, sum = 0, time_s = 0;
    for (std::size_t i = 1; i < samples.size(); ++i) {
        const MuscleSample& now = samples[i];
        if (now.t_s <= from_s || now.t_s > to_s) continue;
        const double step_s = now.t_s - samples[i - 1].t_s;
        min = std::min(min, now.tension_f0);
        max = std::max(max, now.tension_f0);
        sum += step_s * now.tension_f0;
        time_s += step_s;
    }
    measured.add("fusion" + of, "", min / max);
    measured.add("mean_f0" + of, "F0", sum / time_s);
}

void measure(const HistoryPlan& plan, const HistoryRun& run, const MuscleMotion& motion,
             Measurements& measured) {
    const std::string of = "/" + run.muscle.name;
    const std::vector<MuscleSample>& samples = motion.samples;
    const MuscleSample& peak = *std::max_element(samples.begin(), samples.end(), weaker);
    double change = 0;
    for (const MuscleSample& sample : samples)
        if (std::abs(sample.volume_ratio - 1) > std::abs(change)) change = sample.volume_ratio - 1;
    measured.add("peak_f0" + of, "F0", peak.tension_f0);
    measured.add("peak_time_s" + of, "s", peak.t_s);
    measured.add("final_f0" + of, "F0", motion.diverged ? kNever : samples.back().tension_f0);
    measured.add("volume_change_percent" + of, "%", 100 * change);
    measured.add("unconverged" + of, "", motion.converged && !motion.diverged ? 0 : 1);
    if (plan.release_s) measure_release(samples, *plan.release_s, of, measured);
    if (run.drive.pulses) measure_pulses(samples, *run.drive.pulses, of, measured);
}

Table table_of(const HistoryRun& run, const MuscleMotion& motion) {
    Table table{.name = "history_" + run.muscle.name, .columns = {"time_s", "length"}, .rows = {}};
    for (const Quantity& quantity : kQuantities) table.columns.push_back(quantity.column);
    for (const MuscleSample& sample : motion.samples) {
        table.rows.push_back(
            {sample.t_s, normalised_length(run.muscle.muscle, sample.lengthening_m)});
        for (const Quantity& quantity : kQuantities)
            table.rows.back().push_back(quantity.of(sample));
    }
    return table;
}

plot::Chart chart_of(const Shown& shown, const HistoryPlan& plan,
                     const std::vector<MuscleMotion>& motions) {
    plot::Chart chart{.name = shown.name,
                      .title = shown.title,
                      .x = {.label = "time (s)", .range = {{shown.from_s, shown.to_s}}},
                      .y = {.label = shown.quantity->label}};
    for (std::size_t r = 0; r < motions.size(); ++r) {
        plot::Series series{.label = plan.runs[r].muscle.label, .mark = plan.runs[r].mark};
        for (const MuscleSample& sample : motions[r].samples) {
            if (sample.t_s < shown.from_s || sample.t_s > shown.to_s) continue;
            series.x.push_back(sample.t_s);
            series.y.push_back(shown.quantity->of(sample));
        }
        chart.series.push_back(std::move(series));
    }
    return chart;
}

}  // namespace

void run_muscle_history(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome) {
    const HistoryPlan plan = read_history(experiment);
    std::vector<MuscleMotion> motions(plan.runs.size());
    Progress progress(options, static_cast<double>(plan.runs.size()));
    parallel_for(static_cast<int>(plan.runs.size()), options.threads, [&](int i) {
        const auto at = static_cast<std::size_t>(i);
        const HistoryRun& run = plan.runs[at];
        const auto plate_m = [&run](double t_s) {
            return lengthening_m(run.muscle.muscle, run.length(t_s));
        };
        motions[at] = move_muscle(
            run.muscle.muscle,
            {.task = {run.drive.activation, plate_m}, .load = {}, .phases = plan.phases}, options);
        progress.done(1, run.muscle.label);
    });

    for (std::size_t r = 0; r < plan.runs.size(); ++r) {
        outcome.figure.tables.push_back(table_of(plan.runs[r], motions[r]));
        measure(plan, plan.runs[r], motions[r], outcome.measured);
    }
    for (const Shown& shown : plan.shown)
        outcome.figure.charts.push_back(chart_of(shown, plan, motions));
}

}  // namespace risorius::figures
