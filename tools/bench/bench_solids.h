// How fast this machine steps deformable solids of cells in real time: the thesis' cube under a ceiling, let go at rest and
// measured while it swings.
//
//   accuracy   |x - x_c| / |x_c - x_n|, RMS over nodes: x_c is the same step from the same state, converged
//   time       processor time of one core per step
#pragma once

#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/progress_monitor.h"

namespace risorius::bench {

struct SolidBenchOptions {
    std::vector<int> nodes_per_edge = {13, 22, 46};  ///< ascending
    double psi_n_per_m5 = 100;  ///< volume parameter psi_c; K / mu = 2 psi_c L^2 / lambda = 1200
    double accuracy = 0.01;  ///< the fewest iterations are taken that keep every checked step below
    int first_step = 10, steps = 30;  ///< measured ones
    int check_every = 6;              ///< of the measured steps, how often the accuracy is
    int newton_nodes_per_edge =
        13;  ///< up to here a converged step of Newton's method is timed too
};

/// "cases": nodes, iterations, step_ms (median), least_step_ms, median_error, worst_error, converged_step_ms, newton_step_ms
/// (or null), and the growth exponents of time over nodes between one case and the next.
Json bench_solids(const SolidBenchOptions& options, const ProgressMonitor& monitor = {});

}  // namespace risorius::bench
