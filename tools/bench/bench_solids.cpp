// SPDX-License-Identifier: MIT
#include "tools/bench/bench_solids.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "risorius/core/json_object.h"
#include "risorius/report/stopwatch.h"
#include "risorius/solve/integrator.h"
#include "risorius/solve/real_time_step.h"
#include "risorius/tissue/cell_preconditioner.h"
#include "risorius/tissue/gravity.h"
#include "risorius/tissue/grid_shape.h"

namespace risorius::bench {

namespace {

constexpr double kStep_s = 1.0 / 60, kEdge_m = 3;
constexpr int kMinIterations = 2, kMaxIterations = 30;

/// The cube of figures 5 and 9: 4 kg, lambda 1.5 N/m^3, omega 0.1 N s/m^3, fixed at the uppermost plane of a3.
struct HangingCube {
    std::shared_ptr<tissue::CellSolid> solid;
    solve::MotionSystem system;
    solve::MotionState at_rest;

    HangingCube(int nodes_per_edge, double psi) : HangingCube(body(nodes_per_edge, psi)) {}

  private:
    explicit HangingCube(tissue::CellBody body)
        : solid(std::make_shared<tissue::CellSolid>(std::move(body))),
          system(solid->body().mass_kg, ceiling(solid->mesh().root())) {
        system.add(solid);
        system.add(std::make_shared<tissue::Gravity>(solid->body().mass_kg));
        at_rest.x = solid->body().rest;
        at_rest.v = Points::Zero(at_rest.x.rows(), 3);
    }
    static tissue::CellBody body(int nodes_per_edge, double psi) {
        tissue::GridSolid cube;
        cube.grid = {nodes_per_edge, nodes_per_edge, nodes_per_edge};
        cube.rest = tissue::block_rest(cube.grid, Vec3::Constant(kEdge_m));
        cube.material = {tissue::isotropic_material(1.5, 0.1, psi, 4.0, 0.0)};
        return tissue::cell_body(cube);
    }
    static std::vector<char> ceiling(const tissue::GridShape& grid) {
        std::vector<char> fixed(static_cast<std::size_t>(grid.size()), 0);
        for (const int node : tissue::plane_nodes(grid, 2, grid.o - 1))
            fixed[static_cast<std::size_t>(node)] = 1;
        return fixed;
    }
};

double middle_of(std::vector<double> values) {
    const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), half, values.end());
    return *half;
}

struct Fall {
    std::vector<double> step_ms, converged_ms, error;
};

/// Releases the cube, with a fixed number of iterations per step. Some steps are also converged to measure the error. Stops early
/// when an error exceeds the limit.
Fall fall(const HangingCube& cube,
          const std::shared_ptr<tissue::CellPreconditioner>& preconditioner, int iterations,
          const SolidBenchOptions& options) {
    const auto stepper = [&](solve::RealTimeOptions how) {
        how.step_s = kStep_s;
        how.length_scale_m = kEdge_m;
        return solve::RealTimeStep(cube.system, preconditioner, how);
    };
    solve::RealTimeStep fast = stepper({.iterations = iterations});
    solve::RealTimeStep converged = stepper({.iterations = 100, .memory = 20, .accuracy = 1e-6});
    Fall run;
    solve::MotionState state = cube.at_rest;
    for (int step = 0; step < options.first_step + options.steps; ++step) {
        const solve::MotionState before = state;
        const report::CoreStopwatch stopwatch;
        fast.advance(state);
        if (step < options.first_step) continue;
        run.step_ms.push_back(1e3 * stopwatch.seconds());
        if ((step - options.first_step) % options.check_every) continue;
        solve::MotionState exact = before;
        const report::CoreStopwatch checking;
        converged.advance(exact);
        run.converged_ms.push_back(1e3 * checking.seconds());
        run.error.push_back((state.x - exact.x).norm() / (exact.x - before.x).norm());
        if (!(run.error.back() <= options.accuracy)) break;
    }
    return run;
}

/// One converged step of Newton's method with a direct solver, ms.
double newton_ms(const HangingCube& cube) {
    const auto newton = solve::make_integrator({.method = solve::Method::kImplicitEuler,
                                                .step_s = kStep_s,
                                                .length_scale_m = kEdge_m,
                                                .newton_tolerance = 1e-7});
    solve::MotionState state = cube.at_rest;
    // The first step also analyses the sparsity of the matrix
    newton->advance(cube.system, state, kStep_s);
    const report::CoreStopwatch stopwatch;
    newton->advance(cube.system, state, 2 * kStep_s);
    return 1e3 * stopwatch.seconds();
}

}  // namespace

Json bench_solids(const SolidBenchOptions& options, const ProgressMonitor& monitor) {
    Json out;
    out["step_s"] = kStep_s;
    out["psi_n_per_m5"] = options.psi_n_per_m5;
    out["accuracy"] = options.accuracy;
    out["cases"] = Json::array();
    out["growth_exponents"] = Json::array();
    double nodes_before = 0, ms_before = 0;
    int iterations = kMinIterations;  // finer grids need at least as many
    for (std::size_t i = 0; i < options.nodes_per_edge.size(); ++i) {
        const int edge = options.nodes_per_edge[i];
        const double fraction =
            static_cast<double>(i) / static_cast<double>(options.nodes_per_edge.size());
        const std::string name = "solid of " + std::to_string(edge) + "^3 nodes";
        monitor.report(fraction, name);
        const HangingCube cube(edge, options.psi_n_per_m5);
        const auto preconditioner =
            std::make_shared<tissue::CellPreconditioner>(cube.system, cube.solid, kStep_s);

        Fall run = fall(cube, preconditioner, iterations, options);
        while (!(run.error.back() <= options.accuracy) && iterations < kMaxIterations) {
            monitor.report(fraction, name);
            run = fall(cube, preconditioner, ++iterations, options);
        }
        const double nodes = cube.system.size(), ms = middle_of(run.step_ms);
        out["cases"].push_back(json_object(
            {{"nodes", cube.system.size()},
             {"iterations", iterations},
             {"step_ms", ms},
             {"least_step_ms", *std::min_element(run.step_ms.begin(), run.step_ms.end())},
             {"median_error", middle_of(run.error)},
             {"worst_error", *std::max_element(run.error.begin(), run.error.end())},
             {"converged_step_ms", middle_of(run.converged_ms)},
             {"newton_step_ms",
              edge <= options.newton_nodes_per_edge ? Json(newton_ms(cube)) : Json(nullptr)}}));
        if (i > 0)
            out["growth_exponents"].push_back(std::log(ms / ms_before) /
                                              std::log(nodes / nodes_before));
        nodes_before = nodes;
        ms_before = ms;
    }
    return out;
}

}  // namespace risorius::bench
