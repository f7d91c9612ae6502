// SPDX-License-Identifier: MIT
#include "risorius/figures/detail/force_curves.h"

#include <algorithm>
#include <cmath>

#include "risorius/muscle/curve_sets.h"
#include "risorius/muscle/published_tables.h"

namespace risorius::figures {
namespace {

constexpr int kSamples = 301;
constexpr int kTableColour = 6;

struct CurveSet {
    std::string name, label;
    muscle::MuscleCurves curves;
};

/// One of the four curves, and its range in the chart.
struct NamedCurve {
    std::string_view name;
    muscle::Curve muscle::MuscleCurves::*of;
    Range drawn;
    const char* x_label;
};

constexpr const char* kLengthAxis = "fibre length / l0";
const NamedCurve kCurves[] = {
    {"active", &muscle::MuscleCurves::active, {0.3, 1.9}, kLengthAxis},
    {"passive", &muscle::MuscleCurves::passive, {0.3, 1.9}, kLengthAxis},
    {"velocity", &muscle::MuscleCurves::velocity, {-1.1, 1}, "speed / vmax (lengthening > 0)"},
    {"tendon", &muscle::MuscleCurves::tendon, {-0.005, 0.06}, "tendon strain"}};

/// Tabulated points of Zajac and Delp for a curve.
muscle::PublishedTable points_for(std::string_view curve, bool all) {
    if (curve == "active") return muscle::published_active_force();
    if (curve == "passive") return muscle::published_passive_force();
    muscle::PublishedTable points;
    if (curve == "velocity")
        for (const auto& point : muscle::published_velocity_force())
            if (all || point.first <= 0) points.push_back(point);
    return points;
}

std::vector<CurveSet> read_sets(const JsonCursor& experiment) {
    std::vector<CurveSet> sets;
    for (const JsonCursor& json : experiment.at("sets").items()) {
        json.allow_keys({"name", "label", "curves"});
        const std::string name = json.at("name").string();
        for (const CurveSet& other : sets)
            if (other.name == name)
                json.at("name").fail("a name of its own", "\"" + name + "\" again");
        sets.push_back({name, json.at("label").string(),
                        muscle::make_curves(muscle::read_curve_shape(json.at("curves")))});
    }
    if (sets.empty()) experiment.at("sets").fail("at least one set of curves");
    return sets;
}

std::vector<double> read_places(const JsonCursor& experiment, std::string_view curve) {
    std::vector<double> places;
    const auto at = experiment.find("at");
    if (!at) return places;
    at->allow_keys({"active", "passive", "velocity", "tendon"});
    if (const auto list = at->find(curve))
        for (const JsonCursor& one : list->items()) places.push_back(one.number({-10, 10}));
    return places;
}

double place_of(const NamedCurve& curve, int sample) {
    return curve.drawn.min + (curve.drawn.max - curve.drawn.min) * sample / (kSamples - 1);
}

double max_slope_jump(const muscle::Curve& curve) {
    constexpr double kBeside = 1e-9;
    double max = 0;
    for (const double x : curve.joints())
        max = std::max(max, std::abs(curve.at(x + kBeside).slope - curve.at(x - kBeside).slope));
    return max;
}

void measure_curve(const CurveSet& set, const NamedCurve& named, const std::vector<double>& places,
                   Measurements& measured) {
    const std::string of = "/" + set.name + "/" + std::string(named.name);
    const muscle::Curve& curve = set.curves.*named.of;
    for (const double x : places)
        measured.add("value" + of + "/" + format_number(x), "F0", curve.value(x));
    double distance = 0;
    const muscle::PublishedTable points = points_for(named.name, /*all=*/false);
    for (const auto& [x, f] : points) distance = std::max(distance, std::abs(curve.value(x) - f));
    if (!points.empty()) measured.add("table_distance" + of, "F0", distance);
    measured.add("slope_jump" + of, "", max_slope_jump(curve));
}

/// A chart of curves over the same axis, with one colour per set.
plot::Chart chart_of_curves(const std::string& name, const std::string& title,
                            const std::vector<CurveSet>& sets,
                            const std::vector<const NamedCurve*>& curves) {
    plot::Chart chart{.name = name,
                      .title = title,
                      .x = {.label = curves.front()->x_label},
                      .y = {.label = "force / F0"}};
    constexpr double kHighest = 2;
    for (const NamedCurve* named : curves) {
        for (std::size_t i = 0; i < sets.size(); ++i) {
            plot::Series series{.label = named == curves.front() ? sets[i].label : "",
                                .mark = plot::Mark::kLine,
                                .colour = static_cast<int>(i)};
            for (int k = 0; k < kSamples; ++k) {
                const double x = place_of(*named, k), f = (sets[i].curves.*named->of).value(x);
                if (f > kHighest) break;
                series.x.push_back(x);
                series.y.push_back(f);
            }
            chart.series.push_back(std::move(series));
        }
        plot::Series points{.label = curves.size() == 1
                                         ? "Zajac/Delp table"
                                         : "Zajac/Delp table: " + std::string(named->name),
                            .mark = plot::Mark::kPoints,
                            .colour = kTableColour};
        for (const auto& [x, f] : points_for(named->name, /*all=*/true)) {
            points.x.push_back(x);
            points.y.push_back(f);
        }
        if (points.x.empty()) continue;  // the tendon has no points
        chart.series.push_back(std::move(points));
    }
    return chart;
}

}  // namespace

void run_muscle_curves(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome) {
    allow_experiment_keys(experiment, {"sets", "at"});
    const std::vector<CurveSet> sets = read_sets(experiment);
    for (const NamedCurve& named : kCurves) {
        const std::vector<double> places = read_places(experiment, named.name);
        Table table{.name = std::string(named.name),
                    .columns = {named.name == "tendon" ? "strain" : "x"},
                    .rows = {}};
        for (int k = 0; k < kSamples; ++k) table.rows.push_back({place_of(named, k)});
        for (const CurveSet& set : sets) {
            options.monitor.throw_if_stopped();
            table.columns.push_back(set.name + "_f0");
            for (std::vector<double>& row : table.rows)
                row.push_back((set.curves.*named.of).value(row.front()));
            measure_curve(set, named, places, outcome.measured);
        }
        outcome.figure.tables.push_back(std::move(table));
    }
    outcome.figure.charts = {
        chart_of_curves("force_length", "Active and passive force over length", sets,
                        {&kCurves[0], &kCurves[1]}),
        chart_of_curves("force_velocity", "Force over speed", sets, {&kCurves[2]}),
        chart_of_curves("tendon", "Force of the tendon", sets, {&kCurves[3]})};
}

}  // namespace risorius::figures
