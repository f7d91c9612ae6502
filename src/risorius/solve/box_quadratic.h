// SPDX-License-Identifier: MIT
/// \file
/// Least squares with limits and a price on every unknown: what a search for muscle activations solves in each round.
///
///   minimise  1/2 x' A x + b' x + sum price_i |x_i|    subject to  least_i <= x_i <= most_i
///
/// by coordinate descent (A symmetric, positive semidefinite), exact for one coordinate at a time; for lasso problems see
/// Friedman, Hastie & Tibshirani 2010, J. Stat. Softw. 33(1). Once a sweep has left every unknown at its limit, at 0 or between them as
/// it was, those between are solved for at once.
#pragma once

#include <Eigen/Core>

namespace risorius::solve {

struct BoxQuadratic {
    Eigen::MatrixXd A;
    Eigen::VectorXd b, price, min, max;
};

/// From `x`, which is moved into the box first. Stops when a sweep changes no unknown by more than `tolerance`, or after
/// `sweeps`; returns how many it took.
int minimise(const BoxQuadratic& problem, Eigen::VectorXd& x, double tolerance = 1e-9,
             int sweeps = 2000);

}  // namespace risorius::solve
