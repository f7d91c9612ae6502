// SPDX-License-Identifier: MIT
/// \file
/// Benchmark of deformable solids of cells: a cube that hangs from a ceiling is released and measured while it swings.
///
///   accuracy   |x - x_c| / |x_c - x_n|, RMS over nodes: x_c is the converged result of the same step from the same state x_n
///   time       CPU time of one core per step
#pragma once

#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/progress_monitor.h"

namespace risorius::bench {

struct SolidBenchOptions {
    std::vector<int> nodes_per_edge = {13, 22, 46};  ///< ascending
    double psi_n_per_m5 = 100;  ///< volume parameter psi_c; K / mu = 2 psi_c L^2 / lambda = 1200
    /// The smallest number of iterations is used that keeps the error of every checked step below this
    double accuracy = 0.01;
    int first_step = 10, steps = 30;  ///< unmeasured steps at the start, and measured steps
    int check_every = 6;              ///< the accuracy of every sixth measured step is checked
    /// Up to this size a converged step of Newton's method is also timed
    int newton_nodes_per_edge = 13;
};

/// Returns "cases": nodes, iterations, step_ms (median), least_step_ms, median_error, worst_error, converged_step_ms,
/// newton_step_ms (or null), and the exponents with which time grows with the nodes from one case to the next.
Json bench_solids(const SolidBenchOptions& options, const ProgressMonitor& monitor = {});

}  // namespace risorius::bench
