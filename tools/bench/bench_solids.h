// SPDX-License-Identifier: MIT
/// \file
/// Benchmark of deformable solids of cells: a cube that hangs from a ceiling is released at rest and measured while it swings.
///
///   accuracy   |x - x_c| / |x_c - x_n|, RMS over nodes: x_c is the same step from the same state, converged
///   time       processor time of one core for a step
#pragma once

#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/progress_monitor.h"

namespace risorius::bench {

struct SolidBenchOptions {
    std::vector<int> nodes_per_edge = {13, 22, 46};  ///< ascending
    double psi_n_per_m5 = 100;  ///< volume parameter psi_c; K / mu = 2 psi_c L^2 / lambda = 1200
    double accuracy =
        0.01;  ///< the least number of iterations is used that keeps the error of every checked step below this
    int first_step = 10, steps = 30;  ///< unmeasured steps at the beginning, and measured steps
    int check_every = 6;              ///< the accuracy of every sixth measured step is checked
    int newton_nodes_per_edge =
        13;  ///< up to this size a converged step of Newton's method is timed too
};

/// "cases": nodes, iterations, step_ms (median), least_step_ms, median_error, worst_error, converged_step_ms, newton_step_ms
/// (or null), and the growth exponents of time over nodes between one case and the next.
Json bench_solids(const SolidBenchOptions& options, const ProgressMonitor& monitor = {});

}  // namespace risorius::bench
