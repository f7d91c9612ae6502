// SPDX-License-Identifier: MIT
/// \file
/// Conjugate gradients for a symmetric matrix of 3 x 3 blocks, with the inverses of the diagonal blocks as preconditioner.
///
///   A   3n x 3n, should be positive definite      b, x   n x 3
#pragma once

#include <vector>

#include "risorius/core/types.h"
#include "risorius/solve/hessian_builder.h"

namespace risorius::solve {

struct ConjugateGradientReport {
    int iterations = 0;
    bool converged = false;
    /// A is indefinite; x is the last iterate before that was found.
    bool negative_curvature = false;
};

/// Keeps its buffers between calls.
class ConjugateGradients {
  public:
    /// Starts from x = 0 and ends when |b - A x| <= tolerance |b| in the norm of the preconditioner.
    ConjugateGradientReport solve(const SymmetricBlocks& A, const Points& b, double tolerance,
                                  int iterations, Points& x);

  private:
    std::vector<Mat3> inverse_;
    Points residual_, preconditioned_, direction_, product_;
};

/// y = A x
void multiply(const SymmetricBlocks& A, const Points& x, Points& y);

}  // namespace risorius::solve
