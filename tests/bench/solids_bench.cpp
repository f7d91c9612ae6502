// SPDX-License-Identifier: MIT
// What a real-time step of a solid of cells is made of, on the thesis' cube under a ceiling. The argument is the number of
// nodes along an edge; accuracy and whole steps are in `risorius bench --solids`.
//   solids_bench --benchmark_min_time=1
#include <benchmark/benchmark.h>

#include <memory>
#include <utility>
#include <vector>

#include "risorius/solve/real_time_step.h"
#include "risorius/tissue/cell_preconditioner.h"
#include "risorius/tissue/gravity.h"
#include "risorius/tissue/grid_shape.h"

namespace {

using namespace risorius;

constexpr double kStep = 1.0 / 60;

struct Cube {
    std::shared_ptr<tissue::CellSolid> solid;
    std::unique_ptr<solve::MotionSystem> system;
    std::shared_ptr<tissue::CellPreconditioner> preconditioner;
    solve::MotionState state;

    explicit Cube(int n) {
        tissue::GridSolid cube;
        cube.grid = {n, n, n};
        cube.rest = tissue::block_rest(cube.grid, Vec3::Constant(3));
        cube.material = {tissue::isotropic_material(1.5, 0.1, 100, 4, 0)};
        solid = std::make_shared<tissue::CellSolid>(tissue::cell_body(cube));
        std::vector<char> fixed(static_cast<std::size_t>(cube.grid.size()), 0);
        for (const int node : tissue::plane_nodes(cube.grid, 2, n - 1))
            fixed[static_cast<std::size_t>(node)] = 1;
        const Eigen::VectorXd& mass = solid->body().mass_kg;
        system = std::make_unique<solve::MotionSystem>(mass, fixed);
        system->add(solid);
        system->add(std::make_shared<tissue::Gravity>(mass));
        preconditioner = std::make_shared<tissue::CellPreconditioner>(*system, solid, kStep);
        state = {0, cube.rest, Points::Zero(cube.rest.rows(), 3)};
    }
};

void potential(benchmark::State& run) {
    Cube cube(static_cast<int>(run.range(0)));
    const solve::ImplicitStep step{kStep, kStep, cube.state.x};
    Points gradient;
    for (auto _ : run)
        benchmark::DoNotOptimize(cube.system->potential(step, cube.state.x, gradient));
}

void refresh(benchmark::State& run) {
    Cube cube(static_cast<int>(run.range(0)));
    const solve::ImplicitStep step{kStep, kStep, cube.state.x};
    for (auto _ : run) cube.preconditioner->refresh(step, cube.state.x);
}

void apply(benchmark::State& run) {
    Cube cube(static_cast<int>(run.range(0)));
    const solve::ImplicitStep step{kStep, kStep, cube.state.x};
    cube.preconditioner->refresh(step, cube.state.x);
    Points load, answer;
    cube.system->potential(step, 1.01 * cube.state.x, load);
    for (auto _ : run) cube.preconditioner->apply(load, answer);
}

void step_of_four_iterations(benchmark::State& run) {
    Cube cube(static_cast<int>(run.range(0)));
    solve::RealTimeStep stepper(*cube.system, cube.preconditioner,
                                {.step_s = kStep, .iterations = 4, .length_scale_m = 3});
    for (auto _ : run) stepper.advance(cube.state);
}

BENCHMARK(potential)->Arg(13)->Arg(22)->Arg(46)->Unit(benchmark::kMillisecond);
BENCHMARK(refresh)->Arg(13)->Arg(22)->Arg(46)->Unit(benchmark::kMillisecond);
BENCHMARK(apply)->Arg(13)->Arg(22)->Arg(46)->Unit(benchmark::kMillisecond);
BENCHMARK(step_of_four_iterations)->Arg(13)->Arg(22)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
