// SPDX-License-Identifier: MIT
#include "risorius/figures/detail/adaptive.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "risorius/figures/detail/progress.h"
#include "risorius/softbody/integrator_description.h"
#include "risorius/softbody/refined_body.h"
#include "risorius/solve/newton.h"
#include "risorius/tissue/refine.h"
#include "risorius/tissue/strain_error.h"

namespace risorius::figures {
namespace {

/// Tolerance on meshes that will be refined again: Newton's last displacement over the body's length.
constexpr double kToleranceOnTheWay = 1e-3;

struct Push {
    softbody::NodeSelection nodes;
    Vec3 move_m;
};

struct RefinedRun {
    tissue::RefineOptions options;
    int rounds = 1;
};

struct Case {
    std::string name, caption;
    softbody::BodyDescription body;
    tissue::GridSolid solid;
    std::optional<Push> push;
    int watched_axis = 0;
    bool watched_last = false;
    int uniform_levels = 0;
    RefinedRun refine, reference;
};

void read_watch(const JsonCursor& json, Case& one) {
    json.allow_keys({"a1", "a2", "a3"});
    int named = 0;
    for (int axis = 0; axis < 3; ++axis)
        if (const auto end = json.find("a" + std::to_string(axis + 1))) {
            ++named;
            one.watched_axis = axis;
            one.watched_last = end->one_of({"first", "last"}) == "last";
        }
    if (named != 1) json.fail("one of \"a1\" \"a2\" \"a3\"");
}

RefinedRun read_refine(const JsonCursor& json) {
    json.allow_keys({"tolerance", "merge_below", "deepest_level", "rounds"});
    const auto fraction = [](const JsonCursor& value, bool zero) {
        const double number = value.number({0, 1});
        if (number == 1 || (number == 0 && !zero))
            value.fail(zero ? "a number in [0, 1)" : "a number in (0, 1)");
        return number;
    };
    RefinedRun run;
    run.options.tolerance = fraction(json.at("tolerance"), /*zero=*/false);
    if (const auto merge = json.find("merge_below"))
        run.options.merge_below = fraction(*merge, /*zero=*/true);
    run.options.deepest_level = json.at("deepest_level").integer(0, 8);
    run.rounds = json.at("rounds").integer(1, 100);
    return run;
}

std::vector<Case> read_cases(const JsonCursor& experiment) {
    std::vector<Case> cases;
    for (const JsonCursor& json : experiment.at("cases").items()) {
        json.allow_keys(
            {"name", "caption", "body", "push", "watch", "uniform_levels", "refine", "reference"});
        Case one;
        one.name = json.at("name").string();
        for (const Case& other : cases)
            if (other.name == one.name)
                json.at("name").fail("a name of its own", "\"" + one.name + "\" again");
        one.caption = json.at("caption").string();
        one.body = softbody::read_body(json.at("body"));
        softbody::check_refinable(one.body);
        one.solid = softbody::grid_solid(one.body);
        tissue::check(one.solid, one.body.place);
        if (const auto push = json.find("push")) {
            push->allow_keys({"nodes", "move_m"});
            one.push = {softbody::read_node_selection(push->at("nodes"), 3),
                        push->at("move_m").vec3()};
            if (softbody::select(one.push->nodes, one.body.grid).empty())
                push->at("nodes").fail("at least one node");
            if (one.push->move_m.isZero(0)) push->at("move_m").fail("a move");
        }
        read_watch(json.at("watch"), one);
        one.uniform_levels = json.at("uniform_levels").integer(0, 5);
        one.refine = read_refine(json.at("refine"));
        one.reference = read_refine(json.at("reference"));
        cases.push_back(std::move(one));
    }
    if (cases.empty()) experiment.at("cases").fail("at least one case");
    return cases;
}

struct Answers {
    double move_m = 0, push_n = 0, volume_change_percent = 0;
};

/// Counted cost of a series: the same on any machine.
struct Work {
    double assembled_cells = 0;  ///< assembled Hessians of a cell's energy
    double multiplications = 0;  ///< of conjugate gradients

    /// Both counts as one number for the charts: the Hessian of a cell takes about as long as this many multiplications.
    double total() const { return multiplications + 3e4 * assembled_cells; }
    void add(const Work& other) {
        assembled_cells += other.assembled_cells;
        multiplications += other.multiplications;
    }
    /// The larger fraction of the two counts, an upper bound for any weighting of them.
    double fraction_of(const Work& whole) const {
        return std::max(assembled_cells / whole.assembled_cells,
                        multiplications / whole.multiplications);
    }
};

/// One equilibrium of a series of increasingly fine meshes.
struct Rest {
    int nodes = 0, cells = 0, deepest = 0;
    long solves = 0;
    Work own, all;  ///< of this mesh alone, and including all meshes before it
    double energy_j = 0, estimated_error = 0, mass_kg = 0, last_move_m = 0;
    Answers answers;
};

struct Series {
    std::vector<Rest> rests = {};
    bool converged = false;  ///< of all meshes
    Shape shape = {};        ///< on the last mesh
};

/// Solves one case for equilibrium on a series of meshes and records the cost.
class EquilibriumSolver {
  public:
    EquilibriumSolver(const Case& one, const solve::IntegratorOptions& options,
                      const RunOptions& run)
        : case_(one), options_(options), run_(run) {
        length_m_ =
            (one.solid.rest.colwise().maxCoeff() - one.solid.rest.colwise().minCoeff()).maxCoeff();
    }

    bool operator()(const std::shared_ptr<tissue::CellSolid>& solid, tissue::SolveStage stage,
                    solve::MotionState& state) {
        run_.monitor.throw_if_stopped();
        std::vector<softbody::NodeSelection> pushed;
        if (case_.push) pushed.push_back(case_.push->nodes);
        const solve::MotionSystem system = softbody::refined_system(case_.body, solid, pushed);
        const std::vector<char> moved = softbody::held_nodes(pushed, solid->mesh());
        for (int i = 0; i < system.size(); ++i)
            if (moved[static_cast<std::size_t>(i)])
                state.x.row(i) = solid->body().rest.row(i) + case_.push->move_m.transpose();

        solve::NewtonOptions newton;
        newton.iterations = options_.newton_iterations;
        newton.tolerance_m =
            length_m_ * (stage == tissue::SolveStage::kFinal
                             ? options_.newton_tolerance
                             : std::max(options_.newton_tolerance, kToleranceOnTheWay));
        newton.curvature = options_.curvature;
        newton.linear = solve::LinearSolver::kConjugate;
        newton.first_step_s = options_.step_s;
        newton.farthest_m = options_.diverged_at * length_m_;
        const Points start = state.x;
        const solve::NewtonReport report = solve::Newton().solve_equilibrium(
            system, {.end_s = state.t_s, .step_s = kInfinity, .start = start}, newton, state.x);
        note(*solid, system, moved, state, report);
        return report.converged;
    }

    std::vector<Rest> rests;

  private:
    void note(const tissue::CellSolid& solid, const solve::MotionSystem& system,
              const std::vector<char>& moved, const solve::MotionState& state,
              const solve::NewtonReport& report) {
        const Points& x = state.x;
        Rest rest;
        rest.nodes = solid.mesh().node_count();
        rest.cells = static_cast<int>(solid.mesh().cells().size());
        rest.deepest = solid.mesh().deepest_level();
        rest.solves = report.linear_solves;
        rest.own = {.assembled_cells =
                        static_cast<double>(rest.cells) * static_cast<double>(report.linear_solves),
                    .multiplications = report.multiplications};
        rest.all = rest.own;
        if (!rests.empty()) rest.all.add(rests.back().all);
        // A further solve on the same mesh replaces the last entry.
        if (&solid == noted_) {
            rest.solves += rests.back().solves;
            rest.own.add(rests.back().own);
            rests.pop_back();
        }
        noted_ = &solid;
        rest.last_move_m = report.last_move_m;
        rest.mass_kg = solid.body().mass_kg.sum();
        rest.energy_j = solid.energy(state.t_s, x);
        if (rest.energy_j > 0)
            rest.estimated_error = std::sqrt(tissue::squared_error(solid, x).sum() / rest.energy_j);
        rest.answers.volume_change_percent = 100 * (solid.volume(x) / solid.rest_volume() - 1);
        const Points& still = solid.body().rest;
        const int axis = case_.watched_axis;
        const auto centre = [&](const Points& at, bool last) {
            return softbody::face_centre(solid, at, axis, last);
        };
        const Vec3 outward =
            (centre(still, case_.watched_last) - centre(still, !case_.watched_last)).normalized();
        rest.answers.move_m =
            outward.dot(centre(x, case_.watched_last) - centre(still, case_.watched_last));
        if (case_.push) {
            Points force = Points::Zero(x.rows(), 3);
            system.force(state.t_s, x, Points::Zero(x.rows(), 3), force);
            Vec3 sum = Vec3::Zero();
            for (Eigen::Index i = 0; i < x.rows(); ++i)
                if (moved[static_cast<std::size_t>(i)]) sum -= force.row(i).transpose();
            rest.answers.push_n = sum.dot(case_.push->move_m.normalized());
        }
        rests.push_back(rest);
    }

    const Case& case_;
    const solve::IntegratorOptions& options_;
    const RunOptions& run_;
    const tissue::CellSolid* noted_ = nullptr;  ///< the solid of the last entry
    double length_m_ = 1;
};

/// Strain without rotation at the vertices as a colour value: 0 for none, 1 for the maximum. The square root makes weak strain
/// visible.
std::vector<double> shade_of(const tissue::CellSolid& solid, const Points& x) {
    const std::vector<Mat3> strain = tissue::smooth_strain(solid, x);
    std::vector<double> shade(strain.size(), 0.0);
    for (std::size_t c = 0; c < solid.mesh().cells().size(); ++c) {
        const Mat3 inverse = solid.inverse_rest_metric(static_cast<int>(c));
        for (const int vertex : solid.mesh().cells()[c].vertex) {
            const Mat3 mixed = 0.5 * inverse * strain[static_cast<std::size_t>(vertex)];
            shade[static_cast<std::size_t>(vertex)] =
                std::sqrt(std::max(0.0, (mixed * mixed).trace()));
        }
    }
    const double max = *std::max_element(shade.begin(), shade.end());
    for (double& value : shade) value = max > 0 ? std::sqrt(value / max) : 0.0;
    return shade;
}

Shape shape_of(const Case& one, const tissue::CellSolid& solid, const Points& x,
               const std::string& name, const std::string& caption) {
    softbody::CellBoundary boundary = softbody::boundary_of(solid.mesh());
    Shape shape{.name = name,
                .caption = caption,
                .positions = solid.vertices(x),
                .surface = std::move(boundary.surface),
                .wires = std::move(boundary.wires),
                .fixed = {},
                .shade = shade_of(solid, x),
                .shade_ends = {"no strain", "greatest strain"}};
    const std::vector<char> held = softbody::held_nodes(one.body.fixed, solid.mesh());
    for (std::size_t i = 0; i < held.size(); ++i)
        if (held[i]) shape.fixed.push_back(static_cast<int>(i));
    return shape;
}

Series run_uniform(const Case& one, const solve::IntegratorOptions& options,
                   const RunOptions& run) {
    tissue::AdaptiveSolid solid(one.solid, {.deepest_level = one.uniform_levels});
    EquilibriumSolver solver(one, options, run);
    solve::MotionState state = solid.start();
    bool converged = true;
    for (int level = 0; converged && level <= one.uniform_levels; ++level) {
        solid.refine_where(
            [&](const tissue::CellMesh::Cell& cell) { return cell.place.level < level; }, &state);
        converged = solver(solid.solid(),
                           level < one.uniform_levels ? tissue::SolveStage::kIntermediate
                                                      : tissue::SolveStage::kFinal,
                           state);
    }
    return {.rests = solver.rests, .converged = converged};
}

Series run_refined(const Case& one, const RefinedRun& refined,
                   const solve::IntegratorOptions& options, const RunOptions& run) {
    tissue::AdaptiveSolid solid(one.solid, refined.options);
    EquilibriumSolver solver(one, options, run);
    solve::MotionState state = solid.start();
    const tissue::RefineRounds rounds =
        tissue::solve_and_refine(solid, std::ref(solver), refined.rounds, state);
    return {.rests = solver.rests,
            .converged = rounds.converged,
            .shape = shape_of(one, *solid.solid(), state.x, one.name, one.caption)};
}

double difference_percent(double value, double reference) {
    return reference != 0 ? 100 * std::abs(value / reference - 1) : 0;
}

/// Maximum relative difference of the answers, %. The volume is compared as a whole, not its change.
double difference_percent(const Answers& a, const Answers& reference) {
    return std::max({difference_percent(a.move_m, reference.move_m),
                     difference_percent(a.push_n, reference.push_n),
                     std::abs(a.volume_change_percent - reference.volume_change_percent)});
}

struct NamedSeries {
    std::string name, label;
    const Series& series;
    /// Whether the curve includes the last mesh. False for the reference series, whose last mesh is the reference itself.
    bool to_the_end = true;
};

void tabulate(const Case& one, const std::vector<NamedSeries>& all, const Answers& reference,
              Table& table, FigureResult& figure) {
    plot::Chart chart{
        .name = "error_over_work_" + one.name,
        .title = one.caption,
        .x = {.label = "work of all solves (million multiplications)", .logarithmic = true},
        .y = {.label = "greatest error of an answer (%)", .logarithmic = true}};
    for (const NamedSeries& named : all) {
        plot::Series curve{.label = named.label, .mark = plot::Mark::kLinePoints};
        const std::vector<Rest>& rests = named.series.rests;
        for (std::size_t i = 0; i < rests.size(); ++i) {
            const Rest& rest = rests[i];
            const double error = difference_percent(rest.answers, reference);
            if (named.to_the_end || i + 1 < rests.size()) {
                curve.x.push_back(1e-6 * rest.all.total());
                curve.y.push_back(error);
            }
            table.row_names.push_back(one.name + "/" + named.name + "/" + std::to_string(i));
            table.rows.push_back(
                {static_cast<double>(rest.nodes), static_cast<double>(rest.cells),
                 static_cast<double>(rest.deepest), static_cast<double>(rest.solves),
                 rest.all.assembled_cells, 1e-6 * rest.all.multiplications, rest.answers.move_m,
                 rest.answers.push_n, rest.energy_j, rest.answers.volume_change_percent, error,
                 100 * rest.estimated_error});
        }
        chart.series.push_back(std::move(curve));
    }
    figure.charts.push_back(std::move(chart));
}

void measure(const Case& one, const Series& uniform, const Series& refined, const Series& reference,
             Measurements& measured) {
    const Rest &finest = uniform.rests.back(), &last = refined.rests.back();
    const Answers& truth = reference.rests.back().answers;
    const auto add = [&](const char* what, const char* unit, double value) {
        measured.add(what + ("/" + one.name), unit, value);
    };
    add("converged", "", uniform.converged && refined.converged && reference.converged ? 1 : 0);
    add("difference_percent", "%", difference_percent(last.answers, finest.answers));
    add("energy_difference_percent", "%", difference_percent(last.energy_j, finest.energy_j));
    add("work_share", "", last.all.fraction_of(finest.all));
    add("work_share_of_last", "", last.all.fraction_of(finest.own));
    add("uniform_error_percent", "%", difference_percent(finest.answers, truth));
    add("adaptive_error_percent", "%", difference_percent(last.answers, truth));
    add("mass_change_ratio", "", std::abs(last.mass_kg / finest.mass_kg - 1));
    add("uniform_nodes", "", finest.nodes);
    add("adaptive_nodes", "", last.nodes);
    add("uniform_move_m", "m", finest.answers.move_m);
    add("adaptive_move_m", "m", last.answers.move_m);
    if (one.push) {
        add("uniform_push_n", "N", finest.answers.push_n);
        add("adaptive_push_n", "N", last.answers.push_n);
    }
    add("uniform_volume_change_percent", "%", finest.answers.volume_change_percent);
    add("adaptive_volume_change_percent", "%", last.answers.volume_change_percent);
}

}  // namespace

void run_adaptive(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome) {
    allow_experiment_keys(experiment, {"cases", "integrator"});
    const std::vector<Case> cases = read_cases(experiment);
    const JsonCursor integrator = experiment.at("integrator");
    const solve::IntegratorOptions newton = softbody::read_integrator(integrator);
    if (newton.method != solve::Method::kQuasiStatic)
        integrator.at("method").fail("\"quasi-static\", since bodies are brought to rest");
    if (newton.linear != solve::LinearSolver::kConjugate)
        integrator.at("linear").fail("\"conjugate\", whose work is counted");

    // Three series per case; those that take longest start first.
    const int count = static_cast<int>(cases.size());
    std::vector<Series> uniform(cases.size()), refined(cases.size()), reference(cases.size());
    Progress progress(options, 3.0 * count);
    parallel_for(3 * count, options.threads, [&](int i) {
        const auto at = static_cast<std::size_t>(i % count);
        const Case& one = cases[at];
        if (i < count)
            reference[at] = run_refined(one, one.reference, newton, options);
        else if (i < 2 * count)
            uniform[at] = run_uniform(one, newton, options);
        else
            refined[at] = run_refined(one, one.refine, newton, options);
        progress.done(1, one.name);
    });

    Table table{.name = "meshes",
                .columns = {"nodes", "cells", "deepest_level", "linear_solves", "assembled_cells",
                            "million_multiplications", "move_m", "push_n", "energy_j",
                            "volume_change_percent", "error_percent", "estimated_error_percent"},
                .rows = {}};
    for (std::size_t i = 0; i < cases.size(); ++i) {
        tabulate(cases[i],
                 {{"uniform", "uniform", uniform[i]},
                  {"adaptive", "adaptive, same smallest cells", refined[i]},
                  {"reference", "adaptive, smaller cells", reference[i], /*to_the_end=*/false}},
                 reference[i].rests.back().answers, table, outcome.figure);
        measure(cases[i], uniform[i], refined[i], reference[i], outcome.measured);
        outcome.figure.shapes.push_back(std::move(refined[i].shape));
    }
    outcome.figure.tables.push_back(std::move(table));
}

}  // namespace risorius::figures
