// SPDX-License-Identifier: MIT
#include "risorius/figures/detail/muscle_shapes.h"

#include <cmath>
#include <limits>

#include "risorius/figures/detail/muscle_runs.h"
#include "risorius/figures/detail/progress.h"
#include "risorius/solve/newton.h"

namespace risorius::figures {
namespace {

constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();
/// Displacement of the anchors between consecutive equilibria, l0
constexpr double kStep = 0.05;

struct ShapesPlan {
    std::vector<MuscleRun> runs;
    std::vector<double> shortening;  ///< one per run
    double activation = 1;
};

ShapesPlan read_shapes(const JsonCursor& experiment) {
    allow_experiment_keys(experiment, {"muscle", "runs", "activation"});
    ShapesPlan plan;
    plan.runs = read_runs_of_any_muscle(experiment, {"shortening"});
    for (const MuscleRun& run : plan.runs) {
        const auto v = run.json.find("shortening");
        plan.shortening.push_back(v ? v->number({0, 0.8}) : 0);
    }
    if (const auto v = experiment.find("activation")) plan.activation = v->number({0, 1});
    return plan;
}

struct Contraction {
    Shape rest, contracted;
    double volume_change_percent = 0, bulge = 1, stretch = 1, stretch_difference = 0,
           tension_f0 = 0, unconverged = 0;
    double opening_ratio = kNotMeasured, filled_ratio = kNotMeasured;
};

/// Area inside a ring, bounded by the loop of inner nodes halfway through its thickness.
double opening(const tissue::GridShape& grid, const Points& x) {
    const auto corner = [&](int m) -> Vec3 {
        const int i = m % grid.m;
        return (x.row(grid.index(i, grid.n - 1, (grid.o - 1) / 2)) +
                x.row(grid.index(i, grid.n - 1, grid.o / 2)))
                   .transpose() /
               2;
    };
    Vec3 twice = Vec3::Zero();
    for (int m = 1; m + 1 < grid.m; ++m)
        twice += (corner(m) - corner(0)).cross(corner(m + 1) - corner(0));
    return twice.norm() / 2;
}

double enclosed(const muscle::MuscleShape& shape) {
    double six = 0;
    const Vec3 from = shape.surface_m.row(0).transpose();
    for (Eigen::Index t = 0; t < shape.triangles.rows(); ++t) {
        const auto corner = [&](int k) -> Vec3 {
            return shape.surface_m.row(shape.triangles(t, k)).transpose() - from;
        };
        six += corner(0).dot(corner(1).cross(corner(2)));
    }
    return six / 6;
}

Contraction contract(const MuscleRun& run, double activation, double shortening,
                     const RunOptions& options) {
    double activated = 0, moved_m = 0;
    const softbody::MuscleBody muscle =
        softbody::build_muscle(run.muscle, {.activation = [&](double) { return activated; },
                                            .lengthening_m = [&](double) { return moved_m; }});
    const softbody::SoftBody& body = muscle.body;
    const double l0 = run.muscle.musculotendon.optimal_length_m;
    const double rest_volume = body.volume(body.rest);
    solve::MotionState state = body.start();
    Contraction found;
    found.rest = muscle_shape(muscle, 0, state.x, run.name, run.label + ", at rest");
    const auto solve_equilibrium = [&] {
        options.monitor.throw_if_stopped();
        const solve::IntegratorReport report =
            solve::equilibrium(body.system, state,
                               {.method = solve::Method::kQuasiStatic,
                                .step_s = 1.0 / 60,
                                .length_scale_m = body.length_scale_m});
        if (!report.converged || report.diverged) ++found.unconverged;
        const double change = 100 * (body.volume(state.x) / rest_volume - 1);
        if (std::abs(change) > std::abs(found.volume_change_percent))
            found.volume_change_percent = change;
    };
    constexpr int kActivations = 3;
    for (int i = 1; i <= kActivations; ++i) {
        activated = activation * i / kActivations;
        solve_equilibrium();
    }
    const int steps = static_cast<int>(std::ceil(shortening / kStep - 1e-9));
    for (int i = 1; i <= steps; ++i) {
        moved_m = -shortening * l0 * i / steps;
        solve_equilibrium();
    }
    found.contracted = muscle_shape(muscle, 0, state.x, run.name, "contracted");
    found.bulge = bulge(body, state.x);
    const Eigen::VectorXd stretch = muscle.musculotendon->stretch(state.x);
    found.stretch = stretch.mean();
    found.stretch_difference = stretch.maxCoeff() - stretch.minCoeff();
    found.tension_f0 = muscle.tension(0, state.x);
    if (body.grid.closed)
        found.opening_ratio = opening(body.grid, state.x) / opening(body.grid, body.rest);
    if (run.muscle.shape && run.muscle.shape->form == muscle::MuscleShape::Form::kSurface)
        found.filled_ratio = rest_volume / enclosed(*run.muscle.shape);
    return found;
}

}  // namespace

void run_muscle_shapes(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome) {
    const ShapesPlan plan = read_shapes(experiment);
    std::vector<Contraction> results(plan.runs.size());
    Progress progress(options, static_cast<double>(plan.runs.size()));
    parallel_for(static_cast<int>(plan.runs.size()), options.threads, [&](int i) {
        const auto at = static_cast<std::size_t>(i);
        results[at] = contract(plan.runs[at], plan.activation, plan.shortening[at], options);
        progress.done(1, plan.runs[at].label);
    });
    Table table{.name = "shapes",
                .columns = {"volume_change_percent", "bulge", "stretch", "stretch_difference",
                            "tension_f0"},
                .rows = {}};
    for (std::size_t i = 0; i < results.size(); ++i) {
        Contraction& found = results[i];
        const std::string of = "/" + plan.runs[i].name;
        Measurements& measured = outcome.measured;
        measured.add("volume_change_percent" + of, "%", found.volume_change_percent);
        measured.add("bulge" + of, "", found.bulge);
        measured.add("stretch" + of, "l0", found.stretch);
        measured.add("stretch_difference" + of, "l0", found.stretch_difference);
        measured.add("tension_f0" + of, "F0", found.tension_f0);
        measured.add("unconverged" + of, "", found.unconverged);
        if (!std::isnan(found.opening_ratio))
            measured.add("opening_ratio" + of, "", found.opening_ratio);
        if (!std::isnan(found.filled_ratio))
            measured.add("filled_ratio" + of, "", found.filled_ratio);
        table.row_names.push_back(plan.runs[i].name);
        table.rows.push_back({found.volume_change_percent, found.bulge, found.stretch,
                              found.stretch_difference, found.tension_f0});
        outcome.figure.shapes.push_back(std::move(found.rest));
        outcome.figure.shapes.push_back(std::move(found.contracted));
    }
    outcome.figure.tables.push_back(std::move(table));
}

}  // namespace risorius::figures
