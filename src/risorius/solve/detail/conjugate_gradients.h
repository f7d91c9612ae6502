// SPDX-License-Identifier: MIT
/// \file
/// Conjugate gradients for a symmetric matrix of 3 x 3 blocks, with the inverses of the diagonal blocks as the preconditioner.
///
///   A   3n x 3n, should be positive definite      b, x   n x 3
#pragma once

#include <vector>

#include "risorius/core/types.h"
#include "risorius/solve/hessian_builder.h"

namespace risorius::solve {

/// Outcome of a solve.
struct ConjugateGradientReport {
    int iterations = 0;
    bool converged = false;
    /// True when A was found to be indefinite; x is then the last iterate before that.
    bool negative_curvature = false;
};

/// The solver. It keeps its buffers between calls.
class ConjugateGradients {
  public:
    /// Starts from x = 0 and ends when |b - A x| <= tolerance |b| in the norm of the preconditioner.
    ConjugateGradientReport solve(const SymmetricBlocks& A, const Points& b, double tolerance,
                                  int iterations, Points& x);

  private:
    std::vector<Mat3> inverse_;
    Points residual_, preconditioned_, direction_, product_;
};

/// Computes y = A x, n x 3 each.
void multiply(const SymmetricBlocks& A, const Points& x, Points& y);

}  // namespace risorius::solve
