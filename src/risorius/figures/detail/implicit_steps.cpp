// SPDX-License-Identifier: MIT
#include "risorius/figures/detail/implicit_steps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "risorius/core/json_object.h"
#include "risorius/figures/detail/body_cases.h"
#include "risorius/figures/detail/equilibrium_run.h"
#include "risorius/figures/detail/progress.h"
#include "risorius/figures/detail/step_search.h"
#include "risorius/softbody/integrator_description.h"

namespace risorius::figures {
namespace {

struct MethodRun {
    std::string name, label;
    solve::IntegratorOptions integrator;
    std::optional<JsonCursor> change;
    std::vector<double> published_s;  ///< empty or one per grid
};

struct Plan {
    std::vector<std::string> grids;  ///< names
    std::vector<JsonCursor> bodies;  ///< one per grid
    std::vector<MethodRun> methods;
    std::vector<std::array<std::size_t, 2>> ratios;  ///< pairs of methods to compare
    std::vector<double> steps_s;                     ///< descending
    double duration_s = 0, allowed_error = 0;
    solve::IntegratorOptions to_rest;
    double rest_duration_s = 0;
};

std::size_t method_named(const Plan& plan, const JsonCursor& json) {
    std::vector<std::string_view> names;
    for (const MethodRun& method : plan.methods) names.push_back(method.name);
    const std::string name = json.one_of(names);
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

Plan read_plan(const JsonCursor& experiment) {
    Plan plan;
    experiment.at("body").keys();  // must be an object
    for (const JsonCursor& grid : experiment.at("grids").items()) {
        Json body = experiment.at("body").json();
        body["grid"] = grid.json();
        std::string name;
        for (const JsonCursor& count : grid.items()) {
            if (!name.empty()) name += 'x';
            name += std::to_string(count.integer(2, 1000));
        }
        plan.bodies.push_back(
            JsonCursor::from_json(json_object({{"body", body}}),
                                  experiment.file().string() + " (grid " + name + ")")
                .at("body"));
        plan.grids.push_back(name);
    }
    if (plan.grids.empty()) experiment.at("grids").fail("at least one grid");

    for (const JsonCursor& json : experiment.at("methods").items()) {
        json.allow_keys({"name", "label", "integrator", "change", "published_s"});
        MethodRun method{.name = json.at("name").string(),
                         .label = json.at("label").string(),
                         .integrator = softbody::read_integrator(json.at("integrator")),
                         .change = json.find("change"),
                         .published_s = {}};
        for (const MethodRun& other : plan.methods)
            if (other.name == method.name)
                json.at("name").fail("a name of its own", "\"" + method.name + "\" again");
        if (const auto published = json.find("published_s")) {
            for (const JsonCursor& value : published->items())
                method.published_s.push_back(value.number({0, kInfinity}));
            if (method.published_s.size() != plan.grids.size())
                published->fail("one number per grid, " + std::to_string(plan.grids.size()),
                                std::to_string(method.published_s.size()));
        }
        plan.methods.push_back(std::move(method));
    }
    if (plan.methods.empty()) experiment.at("methods").fail("at least one method");

    if (const auto ratios = experiment.find("ratios"))
        for (const JsonCursor& pair : ratios->items()) {
            const auto names = pair.items();
            if (names.size() != 2) pair.fail("the names of two methods");
            plan.ratios.push_back({method_named(plan, names[0]), method_named(plan, names[1])});
        }

    plan.steps_s = read_step_table(experiment.at("steps"));
    plan.duration_s = experiment.at("duration_s").number({1e-6, 1e6});
    plan.allowed_error = experiment.at("allowed_error").number({1e-6, 1});
    const JsonCursor rest = experiment.at("rest");
    rest.allow_keys({"integrator", "duration_s"});
    plan.to_rest = softbody::read_integrator(rest.at("integrator"));
    plan.rest_duration_s = rest.at("duration_s").number({0, kInfinity});
    return plan;
}

struct Found {
    double step_s = 0;             ///< 0: no step of the table is accepted
    double error_ratio = 0;        ///< at that step
    solve::IntegratorReport cost;  ///< of the run at that step
};

/// Maximum over the nodes of the distance between the mean position in the second half and `rest`, over the body's length;
/// infinite when the motion diverges.
double error_with(const softbody::SoftBody& body, solve::IntegratorOptions integrator,
                  double step_s, double duration_s, const Points& rest, const RunOptions& options,
                  solve::IntegratorReport& cost) {
    integrator.step_s = step_s;
    integrator.length_scale_m = body.length_scale_m;
    const auto steps = solve::make_integrator(integrator);
    solve::MotionState state = body.start();
    body.system.place_fixed(state.t_s, state.x, state.v);
    Points sum = Points::Zero(rest.rows(), 3);
    double weight = 0;
    // A long step may end after the duration; then only its end counts.
    const long count = std::max(1L, std::lround(duration_s / step_s));
    for (long step = 1; step <= count; ++step) {
        options.monitor.throw_if_stopped();
        cost.add(steps->advance(body.system, state, static_cast<double>(step) * step_s));
        if (cost.diverged || !state.x.allFinite()) return kInfinity;
        if (2 * step < count) continue;
        sum += state.x;
        weight += 1;
    }
    return (sum / weight - rest).rowwise().norm().maxCoeff() / body.length_scale_m;
}

Found search(const Plan& plan, const softbody::SoftBody& body, const MethodRun& method,
             const Points& rest, const RunOptions& options) {
    Found found;
    for (const double step_s : plan.steps_s) {
        solve::IntegratorReport cost;
        const double error =
            error_with(body, method.integrator, step_s, plan.duration_s, rest, options, cost);
        if (!(error <= plan.allowed_error)) continue;
        return {step_s, error, cost};
    }
    return found;
}

void add_ratios(const Plan& plan, const std::vector<Found>& found, Outcome& outcome) {
    const std::size_t grids = plan.grids.size(), methods = plan.methods.size();
    for (const auto& [above, below] : plan.ratios)
        for (std::size_t g = 0; g < grids; ++g) {
            // A method without an accepted step counts as worse than the smallest step of the table.
            const double divisor = found[g * methods + below].step_s;
            outcome.measured.add(
                "ratio/" + plan.methods[above].name + "/" + plan.methods[below].name + "/" +
                    plan.grids[g],
                "",
                found[g * methods + above].step_s / (divisor > 0 ? divisor : plan.steps_s.back()));
        }
}

// The equilibria of the bodies, as a table and as shapes.
Table equilibrium_table(const Plan& plan, const std::vector<EquilibriumRun>& rest,
                        Outcome& outcome) {
    Table equilibrium{.name = "rest", .columns = {"force_ratio", "speed_per_s"}, .rows = {}};
    for (std::size_t g = 0; g < plan.grids.size(); ++g) {
        equilibrium.row_names.push_back(plan.grids[g]);
        equilibrium.rows.push_back({rest[g].force_ratio, rest[g].speed_ratio});
        outcome.measured.add("rest_force_ratio/" + plan.grids[g], "", rest[g].force_ratio);
        const softbody::BodyDescription description = softbody::read_body(plan.bodies[g]);
        const softbody::SoftBody body = softbody::build_body(description);
        // The equilibria stand in one row of a picture for comparison.
        outcome.figure.shapes.push_back(shape_of(description, body, rest[g].x, "at-rest",
                                                 "At rest, " + plan.grids[g] + " nodes"));
        outcome.figure.shapes.back().outline = rest_outline(body);
    }
    return equilibrium;
}

}  // namespace

void run_implicit_steps(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome) {
    allow_experiment_keys(experiment, {"body", "grids", "duration_s", "allowed_error", "steps",
                                       "rest", "methods", "ratios"});
    const Plan plan = read_plan(experiment);
    const std::size_t methods = plan.methods.size(), grids = plan.grids.size();
    std::vector<std::vector<softbody::BodyDescription>> bodies(grids);
    for (std::size_t g = 0; g < grids; ++g)
        for (const MethodRun& method : plan.methods)
            bodies[g].push_back(
                changed_body(plan.bodies[g], method.change, plan.grids[g] + " " + method.name));

    Progress progress(options, static_cast<double>(grids * (methods + 1)));
    std::vector<EquilibriumRun> rest(grids);
    parallel_for(static_cast<int>(grids), options.threads, [&](int g) {
        const auto at = static_cast<std::size_t>(g);
        const softbody::SoftBody body = softbody::build_body(softbody::read_body(plan.bodies[at]));
        rest[at] = run_to_equilibrium(body, plan.to_rest, plan.rest_duration_s, options);
        progress.done(1, "rest at " + plan.grids[at]);
    });
    std::vector<Found> found(grids * methods);
    parallel_for(static_cast<int>(found.size()), options.threads, [&](int i) {
        const std::size_t at = static_cast<std::size_t>(i), g = at / methods, m = at % methods;
        const softbody::SoftBody body = softbody::build_body(bodies[g][m]);
        found[at] = search(plan, body, plan.methods[m], rest[g].x, options);
        progress.done(1, plan.methods[m].name + " at " + plan.grids[g]);
    });

    Table steps{.name = "longest_step", .columns = {}, .rows = {}};
    Table cost{
        .name = "cost_of_the_longest_step",
        .columns = {"nodes", "step_s", "error_ratio", "steps", "evaluations", "linear_solves"},
        .rows = {}};
    plot::Chart chart{.name = "longest_step",
                      .title = "Longest step that comes to rest in the right place",
                      .x = {.label = "nodes"},
                      .y = {.label = "time step h (s)", .logarithmic = true}};
    for (const std::string& grid : plan.grids) steps.columns.push_back(grid + "_s");
    for (std::size_t m = 0; m < methods; ++m) {
        const MethodRun& method = plan.methods[m];
        plot::Series measured{.label = method.label,
                              .x = {},
                              .y = {},
                              .mark = plot::Mark::kLinePoints,
                              .colour = static_cast<int>(m)};
        plot::Series published{.label = "",
                               .x = {},
                               .y = {},
                               .mark = plot::Mark::kDashed,
                               .colour = static_cast<int>(m)};
        std::vector<double> row;
        for (std::size_t g = 0; g < grids; ++g) {
            const Found& one = found[g * methods + m];
            const double nodes = bodies[g][m].grid.size();
            outcome.measured.add("step_s/" + method.name + "/" + plan.grids[g], "s", one.step_s);
            row.push_back(one.step_s);
            if (one.step_s > 0) {
                measured.x.push_back(nodes);
                measured.y.push_back(one.step_s);
            }
            if (!method.published_s.empty()) {
                published.x.push_back(nodes);
                published.y.push_back(method.published_s[g]);
            }
            cost.row_names.push_back(method.name + "/" + plan.grids[g]);
            cost.rows.push_back({nodes, one.step_s, one.error_ratio,
                                 static_cast<double>(one.cost.steps),
                                 static_cast<double>(one.cost.evaluations),
                                 static_cast<double>(one.cost.linear_solves)});
        }
        steps.row_names.push_back(method.name);
        steps.rows.push_back(row);
        chart.series.push_back(measured);
        if (!published.x.empty()) {
            published.label = method.label + ", thesis";
            chart.series.push_back(published);
        }
    }
    add_ratios(plan, found, outcome);
    outcome.figure.tables.push_back(std::move(steps));
    outcome.figure.tables.push_back(std::move(cost));
    outcome.figure.tables.push_back(equilibrium_table(plan, rest, outcome));
    outcome.figure.charts.push_back(std::move(chart));
}

}  // namespace risorius::figures
