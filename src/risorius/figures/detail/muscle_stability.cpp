// SPDX-License-Identifier: MIT
#include "risorius/figures/detail/muscle_stability.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <optional>

#include "risorius/figures/detail/linear_modes.h"
#include "risorius/figures/detail/progress.h"
#include "risorius/figures/detail/step_search.h"
#include "risorius/softbody/muscle_body.h"

namespace risorius::figures {
namespace {

constexpr int kFewestNodes = 2, kMaxNodes = 40;  // per edge
/// Growth of a mode above which linear theory counts it as unstable.
constexpr double kGrowthToInstability = 1e6;

struct Plan {
    softbody::MuscleDescription muscle;
    double activation = 1, lengthening_m = 0;
    std::vector<int> edges;  ///< nodes per edge
    std::vector<solve::Method> methods;
    StepSearch search;
    std::vector<int> longer_edges;
    double longer_s = 0;
    std::vector<int> linear_edges;
    std::optional<int> tension_edge;
    solve::Method tension_method = solve::Method::kRungeKutta4;
    double tension_shortest_s = 0, tension_duration_s = 0;

    softbody::MuscleBody build(int edge) const {
        softbody::MuscleDescription at = muscle;
        at.grid = {edge, edge, edge};
        return softbody::build_muscle(
            at, {.activation = [a = activation](double) { return a; },
                 .lengthening_m = [by = lengthening_m](double) { return by; }});
    }
};

int node_count(int edge) { return edge * edge * edge; }

std::string key(const std::string& what, solve::Method method, int edge) {
    return what + "/" + std::string(solve::name_of(method)) + "/" +
           std::to_string(node_count(edge));
}

std::vector<int> read_edges(const JsonCursor& json) {
    std::vector<int> edges;
    for (const JsonCursor& edge : json.items())
        edges.push_back(edge.integer(kFewestNodes, kMaxNodes));
    if (edges.empty()) json.fail("at least one number of nodes per edge");
    return edges;
}

Plan read_plan(const JsonCursor& experiment) {
    allow_experiment_keys(
        experiment, {"muscle", "nodes_per_edge", "activation", "lengthening_m", "duration_s",
                     "methods", "steps", "diverged_at", "longer", "linear_theory", "tension"});
    Plan plan;
    plan.muscle = softbody::read_muscle(experiment.at("muscle"));
    if (const auto grid = experiment.at("muscle").find("grid"))
        grid->fail("no grid here: \"nodes_per_edge\" names them");
    plan.edges = read_edges(experiment.at("nodes_per_edge"));
    if (const auto v = experiment.find("activation")) plan.activation = v->number({0, 1});
    if (const auto v = experiment.find("lengthening_m"))
        plan.lengthening_m = v->number({-plan.muscle.length_m, plan.muscle.length_m});
    plan.methods = read_fixed_step_methods(experiment.at("methods"));
    plan.search.steps_s = read_step_table(experiment.at("steps"));
    plan.search.duration_s = experiment.at("duration_s").number({1e-9, 1e6});
    if (const auto v = experiment.find("diverged_at"))
        plan.search.diverged_at = v->number({1e-3, 1e12});
    if (const auto v = experiment.find("longer")) {
        v->allow_keys({"nodes_per_edge", "duration_s"});
        plan.longer_edges = read_edges(v->at("nodes_per_edge"));
        plan.longer_s = v->at("duration_s").number({1e-9, 1e6});
        for (const int edge : plan.longer_edges)
            if (std::find(plan.edges.begin(), plan.edges.end(), edge) == plan.edges.end())
                v->at("nodes_per_edge").fail("some of the experiment's nodes_per_edge");
    }
    if (const auto v = experiment.find("linear_theory")) {
        v->allow_keys({"nodes_per_edge"});
        plan.linear_edges = read_edges(v->at("nodes_per_edge"));
    }
    if (const auto v = experiment.find("tension")) {
        v->allow_keys({"nodes_per_edge", "method", "shortest_s", "duration_s"});
        plan.tension_edge = v->at("nodes_per_edge").integer(kFewestNodes, kMaxNodes);
        std::vector<std::string_view> names;
        for (const solve::Method method : plan.methods) names.push_back(solve::name_of(method));
        plan.tension_method = solve::method_named(v->at("method").one_of(names));
        plan.tension_shortest_s = v->at("shortest_s").number({0, plan.search.steps_s.front()});
        plan.tension_duration_s = v->at("duration_s").number({1e-9, 1e6});
    }
    return plan;
}

/// Mean pull over F0 in the second half, NaN when the motion diverges.
double mean_tension(const Plan& plan, double step_s, const RunOptions& options) {
    constexpr int kTensionSamples = 1000;
    const softbody::MuscleBody muscle = plan.build(*plan.tension_edge);
    const auto steps = solve::make_integrator({.method = plan.tension_method,
                                               .step_s = step_s,
                                               .length_scale_m = muscle.body.length_scale_m,
                                               .diverged_at = plan.search.diverged_at});
    solve::MotionState state = muscle.body.start();
    double sum = 0;
    for (int i = 0; i < kTensionSamples; ++i) {
        options.monitor.throw_if_stopped();
        const double until_s =
            plan.tension_duration_s * (kTensionSamples + i) / (2.0 * kTensionSamples);
        if (steps->advance(muscle.body.system, state, until_s).diverged)
            return std::numeric_limits<double>::quiet_NaN();
        sum += muscle.tension(state.t_s, state.x);
    }
    return sum / kTensionSamples;
}

/// Searches down the table and beyond its end, because linear theory is cheap.
double longest_of_linear_theory(solve::Method method,
                                const std::vector<std::complex<double>>& lambdas,
                                const StepSearch& search) {
    const double ratio = std::pow(10.0, -1.0 / 12);
    for (double step_s = search.steps_s.front(); step_s > 1e-12; step_s *= ratio)
        if (stays_bounded(method, lambdas, step_s, search.duration_s, kGrowthToInstability))
            return step_s;
    return 0;
}

struct Results {
    std::vector<StableStep> stable;  ///< grid by grid, method by method
    std::vector<StableStep> longer;
    std::vector<double> linear_s;
    std::vector<double> tension_steps_s, tension;
};

/// Runs everything, most work first, so that threads finish together.
Results run_all(const Plan& plan, const RunOptions& options) {
    const std::size_t methods = plan.methods.size();
    Results results;
    results.stable.resize(plan.edges.size() * methods);
    results.longer.resize(plan.longer_edges.size() * methods);
    results.linear_s.resize(plan.linear_edges.size() * methods);
    if (plan.tension_edge)
        for (const double step_s : plan.search.steps_s)
            if (step_s >= plan.tension_shortest_s * (1 - 1e-9))
                results.tension_steps_s.push_back(step_s);
    results.tension.resize(results.tension_steps_s.size());

    struct Task {
        double work;
        std::string what;
        std::function<void()> run;
    };
    std::vector<Task> tasks;
    // The cost of a step is proportional to the nodes; the number of steps grows with the nodes because the stable step falls.
    const auto work = [](int edge, double duration_s) {
        return duration_s * std::pow(node_count(edge), 1.75);
    };
    const auto add_searches = [&](const std::vector<int>& edges, double duration_s,
                                  std::vector<StableStep>& found) {
        for (std::size_t e = 0; e < edges.size(); ++e)
            for (std::size_t m = 0; m < methods; ++m) {
                StableStep& slot = found[e * methods + m];
                tasks.push_back({work(edges[e], duration_s), key("", plan.methods[m], edges[e]),
                                 [&plan, &options, &slot, edge = edges[e], m, duration_s] {
                                     StepSearch search = plan.search;
                                     search.duration_s = duration_s;
                                     slot = longest_stable_step(plan.build(edge).body,
                                                                plan.methods[m], search, options);
                                 }});
            }
    };
    add_searches(plan.edges, plan.search.duration_s, results.stable);
    add_searches(plan.longer_edges, plan.longer_s, results.longer);
    for (std::size_t i = 0; i < results.tension.size(); ++i)
        tasks.push_back({work(*plan.tension_edge, plan.tension_duration_s), "tension", [&, i] {
                             results.tension[i] =
                                 mean_tension(plan, results.tension_steps_s[i], options);
                         }});
    for (std::size_t e = 0; e < plan.linear_edges.size(); ++e)
        tasks.push_back(
            {work(plan.linear_edges[e], plan.search.duration_s), "linear theory", [&, e] {
                 const softbody::MuscleBody muscle = plan.build(plan.linear_edges[e]);
                 const auto lambdas = small_motions(muscle.body, muscle.body.rest);
                 for (std::size_t m = 0; m < methods; ++m)
                     results.linear_s[e * methods + m] =
                         longest_of_linear_theory(plan.methods[m], lambdas, plan.search);
             }});
    std::stable_sort(tasks.begin(), tasks.end(),
                     [](const Task& a, const Task& b) { return a.work > b.work; });
    double whole = 0;
    for (const Task& task : tasks) whole += task.work;
    Progress progress(options, whole);
    parallel_for(static_cast<int>(tasks.size()), options.threads, [&](int i) {
        const Task& task = tasks[static_cast<std::size_t>(i)];
        task.run();
        progress.done(task.work, task.what);
    });
    return results;
}

/// Slope of log(y) over log(x) by least squares over the points with y > 0; NaN with fewer than two.
double exponent(const std::vector<double>& x, const std::vector<double>& y) {
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (!(y[i] > 0)) continue;
        const double a = std::log(x[i]), b = std::log(y[i]);
        n += 1, sx += a, sy += b, sxx += a * a, sxy += a * b;
    }
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

/// Geometric mean of a/b over the indices where both are positive.
double mean_ratio(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (a[i] > 0 && b[i] > 0) sum += std::log(a[i] / b[i]), ++count;
    return count > 0 ? std::exp(sum / count) : std::numeric_limits<double>::quiet_NaN();
}

std::vector<double> steps_of(const std::vector<StableStep>& found, std::size_t method,
                             std::size_t methods) {
    std::vector<double> steps;
    for (std::size_t i = method; i < found.size(); i += methods) steps.push_back(found[i].step_s);
    return steps;
}

void show_limits(const Plan& plan, const Results& results, Outcome& outcome) {
    const std::size_t methods = plan.methods.size();
    Table limits{.name = "longest_stable_step", .columns = {"nodes"}, .rows = {}};
    Table cost{.name = "evaluations", .columns = {"nodes"}, .rows = {}};
    plot::Chart chart{.name = "muscle_stability",
                      .title = "Longest stable step of the muscle experiment",
                      .x = {.label = "time step h (s)", .logarithmic = true},
                      .y = {.label = "number of nodes", .logarithmic = true}};
    std::vector<double> nodes;
    for (const int edge : plan.edges) nodes.push_back(node_count(edge));
    for (std::size_t m = 0; m < methods; ++m) {
        const std::string name{solve::name_of(plan.methods[m])};
        limits.columns.push_back(name + "_s");
        cost.columns.push_back(name);
        const std::vector<double> steps = steps_of(results.stable, m, methods);
        plot::Series series{
            .label = label_of(plan.methods[m]), .x = {}, .y = {}, .mark = plot::Mark::kLinePoints};
        for (std::size_t e = 0; e < steps.size(); ++e) {
            outcome.measured.add(key("step_s", plan.methods[m], plan.edges[e]), "s", steps[e]);
            if (!(steps[e] > 0)) continue;
            series.x.push_back(steps[e]);
            series.y.push_back(nodes[e]);
        }
        chart.series.push_back(std::move(series));
        const double slope = exponent(nodes, steps);
        if (std::isfinite(slope)) outcome.measured.add("exponent/" + name, "", slope);
        if (m + 1 == methods) break;
        const double ratio = mean_ratio(steps, steps_of(results.stable, m + 1, methods));
        if (std::isfinite(ratio))
            outcome.measured.add(
                "ratio/" + name + "/" + std::string(solve::name_of(plan.methods[m + 1])), "",
                ratio);
    }
    for (std::size_t e = 0; e < plan.edges.size(); ++e) {
        limits.rows.push_back({nodes[e]});
        cost.rows.push_back({nodes[e]});
        for (std::size_t m = 0; m < methods; ++m) {
            limits.rows.back().push_back(results.stable[e * methods + m].step_s);
            cost.rows.back().push_back(
                static_cast<double>(results.stable[e * methods + m].evaluations));
        }
    }
    outcome.figure.tables.push_back(std::move(limits));
    outcome.figure.tables.push_back(std::move(cost));
    outcome.figure.charts.push_back(std::move(chart));
}

/// Tables by how many entries of the step table the limit of a longer run differs.
void show_longer(const Plan& plan, const Results& results, Outcome& outcome) {
    const std::size_t methods = plan.methods.size();
    const std::vector<double>& table = plan.search.steps_s;
    const auto place = [&](double step_s) {  // without an accepted step: one after the last
        return std::find(table.begin(), table.end(), step_s) - table.begin();
    };
    for (std::size_t e = 0; e < plan.longer_edges.size(); ++e) {
        const auto same = static_cast<std::size_t>(
            std::find(plan.edges.begin(), plan.edges.end(), plan.longer_edges[e]) -
            plan.edges.begin());
        for (std::size_t m = 0; m < methods; ++m) {
            const double step_s = results.longer[e * methods + m].step_s;
            outcome.measured.add(key("longer_step_s", plan.methods[m], plan.longer_edges[e]), "s",
                                 step_s);
            outcome.measured.add(
                key("longer_table_steps", plan.methods[m], plan.longer_edges[e]), "",
                static_cast<double>(place(step_s) -
                                    place(results.stable[same * methods + m].step_s)));
        }
    }
}

void show_linear(const Plan& plan, const Results& results, Outcome& outcome) {
    if (plan.linear_edges.empty()) return;
    const std::size_t methods = plan.methods.size();
    Table table{.name = "longest_step_of_linear_theory", .columns = {"nodes"}, .rows = {}};
    for (const solve::Method method : plan.methods)
        table.columns.push_back(std::string(solve::name_of(method)) + "_s");
    for (std::size_t e = 0; e < plan.linear_edges.size(); ++e) {
        table.rows.push_back({static_cast<double>(node_count(plan.linear_edges[e]))});
        for (std::size_t m = 0; m < methods; ++m) {
            const double step_s = results.linear_s[e * methods + m];
            table.rows.back().push_back(step_s);
            outcome.measured.add(key("linear_s", plan.methods[m], plan.linear_edges[e]), "s",
                                 step_s);
        }
    }
    outcome.figure.tables.push_back(std::move(table));
}

void show_tension(const Plan& plan, const Results& results, Outcome& outcome) {
    if (!plan.tension_edge) return;
    const std::vector<double>& steps = results.tension_steps_s;
    const double finest = results.tension.back();
    const std::string of = label_of(plan.tension_method) + " at " +
                           std::to_string(node_count(*plan.tension_edge)) + " nodes";
    Table table{.name = "tension", .columns = {"step_s", "mean_tension_f0"}, .rows = {}};
    plot::Series series{.label = of, .x = {}, .y = {}, .mark = plot::Mark::kLinePoints};
    double coarsest = std::numeric_limits<double>::quiet_NaN();
    double right_s = 0;  // largest step from which on all smaller ones are within 1 % of the finest
    for (std::size_t i = 0; i < steps.size(); ++i) {
        if (std::isnan(results.tension[i])) continue;
        if (std::isnan(coarsest)) coarsest = results.tension[i];
        const bool right = std::abs(results.tension[i] / finest - 1) < 0.01;
        if (!right) right_s = 0;
        if (right && right_s == 0) right_s = steps[i];
        table.rows.push_back({steps[i], results.tension[i]});
        series.x.push_back(steps[i]);
        series.y.push_back(results.tension[i]);
    }
    outcome.measured.add("tension_finest_f0", "", finest);
    outcome.measured.add("tension_at_longest_step_f0", "", coarsest);
    outcome.measured.add("step_of_right_tension_s", "s", right_s);
    plot::Chart chart{.name = "muscle_tension",
                      .title = "Mean tension of what does not diverge",
                      .x = {.label = "time step h (s)", .logarithmic = true},
                      .y = {.label = "mean tension / F0"}};
    chart.series.push_back(std::move(series));
    outcome.figure.tables.push_back(std::move(table));
    outcome.figure.charts.push_back(std::move(chart));
}

}  // namespace

void run_muscle_stability(const JsonCursor& experiment, const RunOptions& options,
                          Outcome& outcome) {
    const Plan plan = read_plan(experiment);
    const Results results = run_all(plan, options);
    show_limits(plan, results, outcome);
    show_longer(plan, results, outcome);
    show_linear(plan, results, outcome);
    show_tension(plan, results, outcome);
}

}  // namespace risorius::figures
