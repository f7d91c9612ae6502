// SPDX-License-Identifier: MIT
/// \file
/// Least squares without negative unknowns, for few equations and many unknowns, such as the weights of poses that together give
/// a wanted mouth.
///
///   minimise  |B w - y|^2 + ridge |w|^2 + 2 cost . w    subject to  w >= 0
///
/// B is m x n with m much smaller than n. The problem is solved for the residual r = y - B w, which has m entries: at the minimum
/// w = max(0, B^T r - cost) / ridge. Newton's method finds the r for which both agree, in some ten steps of O(m^2 n). The solution is
/// unique, and a continuous function of y.
#pragma once

#include <Eigen/Core>

namespace risorius::solve {

/// Returns w. `cost` has n entries. `residual`: where the search starts, and the r of the solution afterwards; empty: y. ridge > 0.
Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd& B, const Eigen::VectorXd& y,
                                          const Eigen::VectorXd& cost, double ridge,
                                          Eigen::VectorXd& residual);

}  // namespace risorius::solve
