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

/// x = B b, where B is symmetric, positive definite and approximates the inverse of the second derivative.
using InverseMetric = std::function<void(const Points& b, Points& x)>;

/// Limits and choices of a minimisation.
struct QuasiNewtonOptions {
    int iterations = 6;                    ///< maximum
    int min_iterations = 0;                ///< before the tolerance may end the iteration
    int memory = 6;                        ///< number of pairs kept
    Precision pairs = Precision::kDouble;  ///< precision of the stored pairs
    double step_cap_m = 6e-3;              ///< maximum move of a node in one iteration
    /// Stop when an accepted step moves the nodes by less than this RMS; 0: never.
    double tolerance_rms_m = 0;
    double sufficient_decrease = 1e-4;
    int backtracks = 12;
    /// When all iterations were accepted at their first trial, the last of `iterations` is taken without evaluating E. The
    /// report's energy is then that of the iteration before.
    bool trust_last = false;
};

/// Cost and outcome of a minimisation.
struct StepReport {
    int iterations = 0;
    int evaluations = 0;
    int backtracks = 0;
    double energy_j = 0;
    double last_step_rms_m = 0;
    bool converged = false;  ///< the tolerance was met, or the gradient is exactly zero
    bool stalled = false;    ///< the line search found no lower energy
};

/// Keeps its buffers between calls, so that a simulation allocates nothing after the first frame. Each call starts with an
/// empty memory, so the result depends on earlier calls only through x.
class QuasiNewton {
  public:
    StepReport minimise(const EnergyAndGradient& energy, const SparseCholesky& metric, Points& x,
                        const QuasiNewtonOptions& options);
    /// Tries the moves in `warm_start` first, one after the other; an example is the move of the previous step. Each costs an
    /// evaluation but no solve. Its curvature is remembered even when it does not lead downhill.
    StepReport minimise(const EnergyAndGradient& energy, const InverseMetric& metric, Points& x,
                        const QuasiNewtonOptions& options, std::span<const Points> warm_start = {});

  private:
    /// Takes each of the moves that does not raise the energy `e`. The curvature of every move is remembered.
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
    using Ring = std::vector<Pair<Real>>;  ///< options.memory pairs, or empty
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

/// Moves x downhill. No convergence is a result, not an error. The result does not depend on the clock or on the number of
/// threads.
StepReport minimise(const EnergyAndGradient& energy, const SparseCholesky& metric, Points& x,
                    const QuasiNewtonOptions& options);

}  // namespace risorius::solve
