// SPDX-License-Identifier: MIT
#include "risorius/figures/detail/contact_scenes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "risorius/figures/detail/contact_scene.h"
#include "risorius/figures/detail/progress.h"
#include "risorius/softbody/action_description.h"
#include "risorius/softbody/integrator_description.h"

namespace risorius::figures {
namespace {

struct SlopeRun {
    std::string name, label;
    solve::IntegratorOptions integrator;
    double slip_speed_m_per_s;
};

struct Slope {
    softbody::BodyDescription body;
    contact::ContactMaterial contact;
    std::vector<double> degrees;
    double from_s = 0, to_s = 0;
    std::vector<SlopeRun> runs;
};

Slope read_slope(const JsonCursor& json) {
    json.allow_keys({"body", "contact", "degrees", "from_s", "to_s", "runs"});
    Slope slope;
    slope.body = softbody::read_body(json.at("body"));
    slope.contact = softbody::read_contact(json.at("contact"));
    for (const JsonCursor& angle : json.at("degrees").items())
        slope.degrees.push_back(angle.number({0, 89}));
    if (slope.degrees.empty()) json.at("degrees").fail("at least one angle");
    slope.from_s = json.at("from_s").number({0, kInfinity});
    slope.to_s = json.at("to_s").number({0, kInfinity});
    if (!(slope.to_s > slope.from_s)) json.at("to_s").fail("a time after from_s");
    for (const JsonCursor& run : json.at("runs").items()) {
        run.allow_keys({"name", "label", "integrator", "slip_speed_m_per_s"});
        slope.runs.push_back({run.at("name").string(), run.at("label").string(),
                              softbody::read_integrator(run.at("integrator")),
                              run.at("slip_speed_m_per_s").number({1e-9, kInfinity})});
    }
    return slope;
}

/// Coulomb's law: a body stays until the slope is steeper than its friction angle.
double coulomb_acceleration(double radians, double friction, double gravity) {
    return gravity * std::max(0.0, std::sin(radians) - friction * std::cos(radians));
}

/// Mean acceleration down the slope between from_s and to_s, m/s^2.
double slide(const Slope& slope, const SlopeRun& run, double radians, const RunOptions& options) {
    ContactSceneDescription scene;
    scene.bodies = {slope.body};
    const double gravity = slope.body.gravity_m_per_s2.norm();
    scene.bodies.front().gravity_m_per_s2 =
        gravity * Vec3(std::sin(radians), 0, -std::cos(radians));
    SceneObstacle plane;
    plane.obstacle = std::make_shared<contact::Obstacle>(contact::make_plane());
    scene.obstacles = {plane};
    scene.contact = slope.contact;
    scene.contact.slip_speed_m_per_s = run.slip_speed_m_per_s;
    ContactScene built(scene);
    built.run(run.integrator, slope.from_s, options);
    const double before = built.velocity(0).x();
    built.run(run.integrator, slope.to_s, options);
    return (built.velocity(0).x() - before) / (slope.to_s - slope.from_s);
}

void measure_slope(const Slope& slope, const RunOptions& options, Progress& progress,
                   Outcome& outcome) {
    const double gravity = slope.body.gravity_m_per_s2.norm();
    const std::size_t angles = slope.degrees.size();
    std::vector<double> accelerations(slope.runs.size() * angles);
    parallel_for(static_cast<int>(accelerations.size()), options.threads, [&](int i) {
        const SlopeRun& run = slope.runs[static_cast<std::size_t>(i) / angles];
        const double degrees = slope.degrees[static_cast<std::size_t>(i) % angles];
        accelerations[static_cast<std::size_t>(i)] =
            slide(slope, run, degrees * std::numbers::pi / 180, options);
        progress.done(0.1, "slope");
    });

    Table table{.name = "slope", .columns = {"degrees", "coulomb_m_per_s2"}, .rows = {}};
    plot::Chart chart{.name = "slope",
                      .title = "A soft cube on a slope, friction coefficient " +
                               format_number(slope.contact.friction),
                      .x = {.label = "slope (degrees)"},
                      .y = {.label = "acceleration (m/s^2)"}};
    plot::Series law{.label = "Coulomb", .x = {}, .y = {}, .mark = plot::Mark::kLine};
    constexpr double kStep_deg = 0.5;
    const auto [min, max] = std::minmax_element(slope.degrees.begin(), slope.degrees.end());
    for (double degrees = *min; degrees <= *max; degrees += kStep_deg) {
        law.x.push_back(degrees);
        law.y.push_back(coulomb_acceleration(degrees * std::numbers::pi / 180,
                                             slope.contact.friction, gravity));
    }
    chart.series.push_back(law);
    for (const double degrees : slope.degrees)
        table.rows.push_back({degrees, coulomb_acceleration(degrees * std::numbers::pi / 180,
                                                            slope.contact.friction, gravity)});
    for (std::size_t r = 0; r < slope.runs.size(); ++r) {
        plot::Series series{
            .label = slope.runs[r].label, .x = slope.degrees, .y = {}, .mark = plot::Mark::kPoints};
        table.columns.push_back(slope.runs[r].name + "_m_per_s2");
        double worst = 0;
        for (std::size_t a = 0; a < angles; ++a) {
            const double measured = accelerations[r * angles + a];
            series.y.push_back(measured);
            table.rows[a].push_back(measured);
            worst = std::max(worst, std::abs(measured - table.rows[a][1]));
        }
        chart.series.push_back(series);
        outcome.measured.add("acceleration_error_percent/" + slope.runs[r].name, "% of g",
                             100 * worst / gravity);
    }
    outcome.figure.tables.push_back(table);
    outcome.figure.charts.push_back(chart);
}

}  // namespace

void run_contact_scenes(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome) {
    allow_experiment_keys(experiment, {"integrator", "scenes", "slope"});
    const solve::IntegratorOptions integrator =
        softbody::read_integrator(experiment.at("integrator"));
    std::vector<ContactSceneDescription> scenes;
    for (const JsonCursor& json : experiment.at("scenes").items()) {
        scenes.push_back(read_contact_scene(json));
        for (std::size_t i = 0; i + 1 < scenes.size(); ++i)
            if (scenes[i].name == scenes.back().name)
                json.at("name").fail("a name of its own", "\"" + scenes.back().name + "\" again");
    }
    std::optional<Slope> slope;
    if (const auto json = experiment.find("slope")) slope = read_slope(*json);
    const double slides =
        slope ? 0.1 * static_cast<double>(slope->runs.size() * slope->degrees.size()) : 0;
    Progress progress(options, static_cast<double>(scenes.size()) + slides);

    struct Result {
        Shape shape;
        solve::IntegratorReport report;
        double weight_n = 0, support_ratio = 0, load_ratio = 0, min_gap_m = 0, speed_m_per_s = 0;
        int bodies = 0;
    };
    std::vector<Result> results(scenes.size());
    parallel_for(static_cast<int>(scenes.size()), options.threads, [&](int i) {
        const ContactSceneDescription& scene = scenes[static_cast<std::size_t>(i)];
        Result& result = results[static_cast<std::size_t>(i)];
        ContactScene built(scene);
        result.report = built.run(integrator, scene.duration_s, options);
        result.bodies = built.body_count();
        for (int b = 0; b < built.body_count(); ++b) result.weight_n += built.weight_n(b);
        result.support_ratio = built.support_n().z() / result.weight_n;
        result.load_ratio = -built.load_on_first_n().z() / (result.weight_n - built.weight_n(0));
        result.min_gap_m = built.min_gap_m();
        result.speed_m_per_s = built.max_speed_m_per_s();
        result.shape = built.shape(scene);
        progress.done(1, scene.name);
    });

    Table table{.name = "scenes",
                .columns = {"support_ratio", "least_gap_m", "speed_m_per_s", "steps", "evaluations",
                            "linear_solves"},
                .rows = {}};
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        const Result& result = results[i];
        const std::string& name = scenes[i].name;
        outcome.figure.shapes.push_back(result.shape);
        outcome.measured.add("support_ratio/" + name, "", result.support_ratio);
        if (result.bodies > 1) outcome.measured.add("load_ratio/" + name, "", result.load_ratio);
        outcome.measured.add("least_gap_m/" + name, "m", result.min_gap_m);
        outcome.measured.add("speed_m_per_s/" + name, "m/s", result.speed_m_per_s);
        outcome.measured.add("diverged/" + name, "", result.report.diverged ? 1 : 0);
        table.row_names.push_back(name);
        table.rows.push_back({result.support_ratio, result.min_gap_m, result.speed_m_per_s,
                              static_cast<double>(result.report.steps),
                              static_cast<double>(result.report.evaluations),
                              static_cast<double>(result.report.linear_solves)});
    }
    outcome.figure.tables.push_back(std::move(table));
    if (slope) measure_slope(*slope, options, progress, outcome);
}

}  // namespace risorius::figures
