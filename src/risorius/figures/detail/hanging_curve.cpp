// SPDX-License-Identifier: MIT
#include "risorius/figures/detail/hanging_curve.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/figures/detail/body_cases.h"
#include "risorius/figures/detail/equilibrium_run.h"
#include "risorius/figures/detail/progress.h"
#include "risorius/softbody/integrator_description.h"

namespace risorius::figures {
namespace {

constexpr int kDrawn = 201;  // points of the drawn catenary

double length_of(const Points& x) {
    double length = 0;
    for (Eigen::Index i = 1; i < x.rows(); ++i) length += (x.row(i) - x.row(i - 1)).norm();
    return length;
}

/// Height of the middle of the chord above the lowest point.
double sag_of(const Points& x) {
    return 0.5 * (x(0, 2) + x(x.rows() - 1, 2)) - x.col(2).minCoeff();
}

std::vector<softbody::BodyDescription> read_bodies(const JsonCursor& experiment,
                                                   std::vector<std::string>& names) {
    std::vector<softbody::BodyDescription> bodies;
    for (const JsonCursor& grid : experiment.at("grids").items()) {
        const Json change = json_object({{"grid", grid.json()}});
        const std::string name = json_text(grid.json());
        bodies.push_back(changed_body(experiment.at("body"),
                                      JsonCursor::from_json(change, experiment.file().string()),
                                      name));
        const softbody::BodyDescription& body = bodies.back();
        if (body.kind != softbody::Kind::kCurve)
            experiment.at("body").at("kind").fail("\"curve\", which is what hangs here");
        if (body.gravity_m_per_s2.head<2>().norm() > 0 || !(body.gravity_m_per_s2.z() < 0))
            throw Error(body.place + "/gravity_m_per_s2", "a weight along -z", "another");
        const std::vector<char> fixed = softbody::fixed_flags(body);
        int held = 0;
        for (const char flag : fixed) held += flag;
        if (held != 2 || !fixed.front() || !fixed.back())
            throw Error(body.place + "/fixed", "both ends and nothing else",
                        std::to_string(held) + " nodes");
        const Points rest = softbody::grid_curve(body).rest;
        const Vec3 chord = (rest.row(rest.rows() - 1) - rest.row(0)).transpose();
        if (!(chord.head<2>().norm() > 0) || !(length_of(rest) > chord.norm()))
            throw Error(body.place + "/rest", "a curve that can hang between its ends",
                        "a taut or a vertical one");
        names.push_back(std::to_string(body.grid.m));
    }
    if (bodies.empty()) experiment.at("grids").fail("at least one grid");
    return bodies;
}

plot::Series drawn(const Points& x, const std::string& label, plot::Mark mark) {
    plot::Series series{.label = label, .mark = mark};
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
        series.x.push_back((x.row(i) - x.row(0)).head<2>().norm());
        series.y.push_back(x(i, 2));
    }
    return series;
}

}  // namespace

Points catenary(const Vec3& from, const Vec3& to, double length_m, int points) {
    const Vec3 chord = to - from;
    const double d = chord.head<2>().norm(), v = chord.z();
    // sqrt(L^2 - v^2) = 2 a sinh(d / 2a). With u = d / 2a, sinh(u) / u has to equal `wanted`; it grows from 1.
    const double wanted = std::sqrt(length_m * length_m - v * v) / d;
    double low = 0, high = 1;
    while (std::sinh(high) / high < wanted) high *= 2;
    for (int k = 0; k < 200; ++k) {
        const double u = 0.5 * (low + high);
        (u > 0 && std::sinh(u) / u > wanted ? high : low) = u;
    }
    const double a = d / (low + high);
    const double x0 = d / 2 - a * std::atanh(v / length_m);
    Points x(points, 3);
    for (int i = 0; i < points; ++i) {
        const double s = length_m * i / (points - 1);
        const double along = x0 + a * std::asinh(s / a - std::sinh(x0 / a));
        const double up = a * (std::cosh((along - x0) / a) - std::cosh(x0 / a));
        x.row(i) << (from.head<2>() + along / d * chord.head<2>()).transpose(), from.z() + up;
    }
    return x;
}

void run_hanging_curve(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome) {
    allow_experiment_keys(experiment, {"body", "grids", "integrator", "duration_s"});
    std::vector<std::string> names;
    const std::vector<softbody::BodyDescription> bodies = read_bodies(experiment, names);
    const solve::IntegratorOptions integrator =
        softbody::read_integrator(experiment.at("integrator"));
    const double duration_s = experiment.at("duration_s").number({0, 1e6});

    std::vector<EquilibriumRun> equilibrium(bodies.size());
    Progress progress(options, static_cast<double>(bodies.size()));
    parallel_for(static_cast<int>(bodies.size()), options.threads, [&](int i) {
        const auto at = static_cast<std::size_t>(i);
        equilibrium[at] =
            run_to_equilibrium(softbody::build_body(bodies[at]), integrator, duration_s, options);
        progress.done(1, names[at] + " nodes");
    });

    Table table{.name = "hanging",
                .columns = {"nodes", "sag_m", "sag_error_percent", "distance_ratio",
                            "stretch_percent", "force_ratio"},
                .rows = {}};
    plot::Chart chart{.name = "shape",
                      .title = "A curve hanging between two points",
                      .x = {.label = "x (m)"},
                      .y = {.label = "z (m)"}};
    plot::Chart convergence{.name = "distance",
                            .title = "Distance from the catenary",
                            .x = {.label = "nodes", .logarithmic = true},
                            .y = {.label = "distance over length", .logarithmic = true}};
    plot::Series distances{.label = "greatest distance of a node", .mark = plot::Mark::kLinePoints};
    plot::Series second_order{.label = "h^2, from the first", .mark = plot::Mark::kDashed};
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const Points& x = equilibrium[i].x;
        const softbody::SoftBody body = softbody::build_body(bodies[i]);
        const int nodes = static_cast<int>(x.rows());
        const double length = length_of(body.rest);
        const Points exact = catenary(body.rest.row(0), body.rest.row(nodes - 1), length, nodes);
        const double sag = sag_of(x),
                     exact_sag = sag_of(catenary(body.rest.row(0), body.rest.row(nodes - 1), length,
                                                 20 * (nodes - 1) + 1));
        const double distance = (x - exact).rowwise().norm().maxCoeff() / length;
        outcome.measured.add("sag_m/" + names[i], "m", sag);
        outcome.measured.add("sag_error_percent/" + names[i], "%", 100 * (sag / exact_sag - 1));
        outcome.measured.add("distance_ratio/" + names[i], "", distance);
        outcome.measured.add("stretch_percent/" + names[i], "%", 100 * (length_of(x) / length - 1));
        outcome.measured.add("force_ratio/" + names[i], "", equilibrium[i].force_ratio);
        table.rows.push_back({static_cast<double>(nodes), sag, 100 * (sag / exact_sag - 1),
                              distance, 100 * (length_of(x) / length - 1),
                              equilibrium[i].force_ratio});
        distances.x.push_back(nodes);
        distances.y.push_back(distance);
        second_order.x.push_back(nodes);
        const double h = (distances.x[0] - 1) / (nodes - 1);
        second_order.y.push_back(distances.y[0] * h * h);
        if (i > 0) {
            const double before = distances.y[i - 1],
                         finer = (nodes - 1) / (distances.x[i - 1] - 1);
            outcome.measured.add("order/" + names[i], "",
                                 std::log(before / distance) / std::log(finer));
        }
        if (i == 0)
            chart.series.push_back(
                drawn(catenary(body.rest.row(0), body.rest.row(nodes - 1), length, kDrawn),
                      "catenary", plot::Mark::kLine));
        if (i == 0 || i + 1 == bodies.size())
            // The coarsest grid comes last and is drawn on top.
            chart.series.insert(chart.series.begin() + 1,
                                drawn(x, names[i] + " nodes", plot::Mark::kPoints));
        Shape shape = shape_of(bodies[i], body, x, "hanging", names[i] + " nodes");
        shape.outline = rest_outline(body);
        shape.outline_name = "where it falls from";
        outcome.figure.shapes.push_back(std::move(shape));
    }
    outcome.figure.tables.push_back(std::move(table));
    outcome.figure.charts.push_back(std::move(chart));
    convergence.series = {distances, second_order};
    outcome.figure.charts.push_back(std::move(convergence));
}

}  // namespace risorius::figures
