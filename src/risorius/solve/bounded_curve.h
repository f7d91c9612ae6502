// SPDX-License-Identifier: MIT
/// \file
/// A smooth curve under bounds: a strictly convex quadratic function whose matrix has five diagonals, as second differences do.
///
///   minimise  1/2 x^T A x - b^T x    subject to  min_i <= x_i <= max_i
///
/// The method is block principal pivoting, an active set method. Each round solves for the free unknowns at once, which costs O(n),
/// and then changes the state of all unknowns that break a condition. When this does not reduce their number for some rounds, one
/// unknown of each run of neighbours changes, and at last a single one; then the method ends after a finite number of rounds.
///
/// Source: J. J. Judice, F. M. Pires 1994, Comput. Oper. Res. 21(5), 587-596.
#pragma once

#include <Eigen/Core>

namespace risorius::solve {

/// A is positive definite: diagonal (n), and the next two diagonals, of which entry i stands in column i and rows i + 1 and i + 2
/// (n entries each; those beyond the matrix are not read). The bounds may be infinite; min <= max.
struct CurveQuadratic {
    Eigen::VectorXd diagonal, first, second;
    Eigen::VectorXd b, min, max;
    /// Makes a problem of n unknowns with A = 0, b = 0 and no bounds.
    explicit CurveQuadratic(long n);
    /// Adds weight / 2 (x_i - target)^2.
    void pull(long i, double target, double weight);
    /// Adds weight / 2 (x_{i-1} - 2 x_i + x_{i+1})^2 for all i that have two neighbours.
    void bend(double weight);
};

struct CurveSolution {
    Eigen::VectorXd x;
    int rounds = 0;
    bool converged = false;  ///< all conditions hold
};

CurveSolution minimise(const CurveQuadratic& problem, int max_rounds = 1000);

}  // namespace risorius::solve
