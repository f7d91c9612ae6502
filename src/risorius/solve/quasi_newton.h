// SPDX-License-Identifier: MIT
/// \file
/// L-BFGS over node positions with one prefactored matrix as the initial metric.
///
/// - x: node positions, n x 3, m
/// - E(x): incremental potential, J
/// - A: prefactored metric, N/m
///
/// Source: Liu, Bouaziz & Kavan 2017, "Quasi-Newton methods for real-time simulation of hyperelastic materials", ACM TOG 36(3).
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/solve/lanes.h"
#include "risorius/solve/sparse_cholesky.h"

namespace risorius::solve {

/// Returns E(x) and writes dE/dx (n x 3). Rows of fixed nodes must be zero.
using EnergyAndGradient = std::function<double(const Points& x, Points& gradient)>;

/// x = B b with B symmetric, positive definite and near the inverse of the second derivative.
using InverseMetric = std::function<void(const Points& b, Points& x)>;

struct QuasiNewtonOptions {
    int iterations = 6;                    ///< at most
    int min_iterations = 0;                ///< before the tolerance may stop it
    int memory = 6;                        ///< pairs kept
    Precision pairs = Precision::kDouble;  ///< what they are kept in
    double step_cap_m = 6e-3;              ///< longest move of one node in one iteration
    double tolerance_rms_m =
        0;  ///< stop when an accepted step moves the nodes less than this RMS; 0 = never
    double sufficient_decrease = 1e-4;
    int backtracks = 12;
    /// The last of `iterations` is taken without an evaluation of E where all before it were accepted at their first trial:
    /// the report's energy is then that before it.
    bool trust_last = false;
};

struct StepReport {
    int iterations = 0;
    int evaluations = 0;
    int backtracks = 0;
    double energy_j = 0;
    double last_step_rms_m = 0;
    bool converged = false;  ///< the tolerance was met, or the gradient is exactly zero
    bool stalled = false;    ///< the line search found no lower energy
};

/// Keeps its buffers between calls, so that stepping a simulation allocates nothing after the first
/// frame. Each call starts with an empty memory: frames do not depend on the ones before except
/// through x.
class QuasiNewton {
  public:
    StepReport minimise(const EnergyAndGradient& energy, const SparseCholesky& metric, Points& x,
                        const QuasiNewtonOptions& options);
    /// Tries the moves in `warm_start` first, one after the other, for example the move of the step before. Each costs an
    /// evaluation but no solve, and its curvature is remembered even where it does not lead downhill.
    StepReport minimise(const EnergyAndGradient& energy, const InverseMetric& metric, Points& x,
                        const QuasiNewtonOptions& options, std::span<const Points> warm_start = {});

  private:
    /// Takes each of the moves that does not raise the energy `e`, and remembers the curvature of all.
    void try_moves(const EnergyAndGradient& energy, std::span<const Points> moves, double& e,
                   Points& x, StepReport& report);
    template <class Real>
    struct Pair {
        Eigen::Matrix<Real, Eigen::Dynamic, 3, Eigen::RowMajor> step;             ///< s
        Eigen::Matrix<Real, Eigen::Dynamic, 3, Eigen::RowMajor> gradient_change;  ///< y
        double inverse_product;                                                   ///< 1 / (s . y)
        double alpha;
    };
    template <class Real>
    using Ring = std::vector<Pair<Real>>;  ///< of options.memory pairs, or empty
    void direction(const InverseMetric& metric);
    template <class Real>
    void direction(const InverseMetric& metric, Ring<Real>& pairs);
    void remember(double step_length, const Points& step);
    template <class Real>
    void remember(double step_length, const Points& step, Ring<Real>& pairs);

    Ring<double> in_double_;
    Ring<float> in_single_;
    int newest_ = 0;
    int kept_ = 0;
    Points gradient_, trial_gradient_, trial_, work_, direction_;
};

/// Moves x downhill. Not converging is a result. No allocation that depends on the clock or the
/// thread count.
StepReport minimise(const EnergyAndGradient& energy, const SparseCholesky& metric, Points& x,
                    const QuasiNewtonOptions& options);

}  // namespace risorius::solve
