// SPDX-License-Identifier: MIT
/// \file
/// Least squares with bounds and an L1 weight (`l1_weight`) on every unknown. A search for muscle activations solves one
/// such problem in each round.
///
///   minimise  1/2 x^T A x + b^T x + sum_i l1_weight_i |x_i|    subject to  min_i <= x_i <= max_i
///
/// A is symmetric and positive semidefinite. The method is coordinate descent, exact in one coordinate at a time; for lasso
/// problems see Friedman, Hastie & Tibshirani 2010, J. Stat. Softw. 33(1). An unknown is at a bound, at 0, or free with a
/// positive or negative value. When a sweep over all unknowns has changed none of these states, all free unknowns are solved
/// for at once.
#pragma once

#include <Eigen/Core>

namespace risorius::solve {

/// The problem. A is n x n, and the others have n entries; l1_weight >= 0, min <= max.
struct BoxQuadratic {
    Eigen::MatrixXd A;
    Eigen::VectorXd b, l1_weight, min, max;
};

/// Minimises from `x`, which is clamped to the bounds first. Stops when a sweep changes no unknown by more than `tolerance`, or
/// after `sweeps` sweeps. Returns the number of sweeps.
int minimise(const BoxQuadratic& problem, Eigen::VectorXd& x, double tolerance = 1e-9,
             int sweeps = 2000);

}  // namespace risorius::solve
