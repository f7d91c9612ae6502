// SPDX-License-Identifier: MIT
/// \file
/// L-BFGS over node positions with one prefactored matrix as the initial metric.
///
/// - x: node positions, n x 3, m
/// - E(x): the energy to minimise, J; in a step it is the incremental potential Phi of energy_term.h
/// - A: prefactored metric, N/m, an n x n matrix with one number per pair of nodes, used for x, y and z alike
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

/// Returns E(x), J, and writes dE/dx, n x 3, N. Rows of fixed nodes must be zero.
using EnergyAndGradient = std::function<double(const Points& x, Points& gradient)>;

/// Computes x = B b, n x 3 each. B is symmetric and positive definite, and approximates the inverse of the second derivative of
/// E, m/N.
using InverseMetric = std::function<void(const Points& b, Points& x)>;

/// Limits and choices of a minimisation.
struct QuasiNewtonOptions {
    int iterations = 6;                    ///< maximum number
    int min_iterations = 0;                ///< number of iterations before the tolerance is tested
    int memory = 6;                        ///< number of pairs of L-BFGS that are kept
    Precision pairs = Precision::kDouble;  ///< precision of the stored pairs
    double step_cap_m = 6e-3;              ///< maximum move of a node in one iteration
    /// The iteration ends when the RMS of the moves of the nodes in a step is less than this; 0: never.
    double tolerance_rms_m = 0;
    /// A step is accepted when E falls by at least this fraction of what the gradient predicts (Armijo's rule).
    double sufficient_decrease = 1e-4;
    int backtracks = 12;       ///< maximum number of times that one step is shortened
    double shortest_m = 1e-9;  ///< a move whose longest row is shorter is not shortened any more
    /// If the first trial of every iteration was accepted, the step of the last one is taken without evaluating E. The energy
    /// in the report is then that before this step.
    bool trust_last = false;
};

/// Cost and outcome of a minimisation.
struct StepReport {
    int iterations = 0;
    int evaluations = 0;
    int backtracks = 0;  ///< number of times that a step was shortened
    double energy_j = 0;
    double last_step_rms_m = 0;
    bool converged = false;  ///< the tolerance was met, or the gradient is exactly zero
    bool stalled = false;    ///< the line search found no lower energy
};

/// L-BFGS for functions of node positions. An object keeps its buffers between calls, so that a simulation allocates nothing
/// after the first frame. Each call starts without pairs, so its result depends on earlier calls only through x.
class QuasiNewton {
  public:
    StepReport minimise(const EnergyAndGradient& energy, const SparseCholesky& metric, Points& x,
                        const QuasiNewtonOptions& options);
    /// Tries the moves in `warm_start` first, one after the other, n x 3 each, m; an example is the move of the previous step.
    /// Each move needs an evaluation of E but no solve. It is kept as a pair even when it does not lower E.
    StepReport minimise(const EnergyAndGradient& energy, const InverseMetric& metric, Points& x,
                        const QuasiNewtonOptions& options, std::span<const Points> warm_start = {});

  private:
    /// Makes each of the moves that does not raise the energy `e`. Every move is kept as a pair.
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

/// Minimises E from x with a new QuasiNewton object. Missing convergence is a result; no exception is thrown. The result does
/// not depend on the time that is used or on the number of threads.
StepReport minimise(const EnergyAndGradient& energy, const SparseCholesky& metric, Points& x,
                    const QuasiNewtonOptions& options);

}  // namespace risorius::solve
