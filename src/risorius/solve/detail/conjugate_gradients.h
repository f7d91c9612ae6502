// SPDX-License-Identifier: MIT
/// \file
/// Conjugate gradients on a symmetric matrix of 3 x 3 blocks, preconditioned by the inverses of its diagonal blocks.
///
///   A   3n x 3n, positive definite if all is well      b, x   n x 3
#pragma once

#include <vector>

#include "risorius/core/types.h"
#include "risorius/solve/hessian_builder.h"

namespace risorius::solve {

struct ConjugateGradientReport {
    int iterations = 0;
    bool converged = false;
    bool negative_curvature = false;  ///< A is indefinite; x is the iterate before that showed
};

/// Keeps its buffers between calls.
class ConjugateGradients {
  public:
    /// From x = 0 until |b - A x| <= tolerance |b| in the norm of the preconditioner.
    ConjugateGradientReport solve(const SymmetricBlocks& A, const Points& b, double tolerance,
                                  int iterations, Points& x);

  private:
    std::vector<Mat3> inverse_;
    Points residual_, preconditioned_, direction_, product_;
};

/// y = A x
void multiply(const SymmetricBlocks& A, const Points& x, Points& y);

}  // namespace risorius::solve
