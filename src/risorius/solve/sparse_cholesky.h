// SPDX-License-Identifier: MIT
/// \file
/// Sparse Cholesky factor of a constant n x n matrix, which solves for three right-hand sides at once.
///
///   A   symmetric positive definite, n x n
///   L   its factor after a nested-dissection ordering P, A = P^T L L^T P
#pragma once

#include <Eigen/SparseCore>
#include <memory>

#include "risorius/core/types.h"
#include "risorius/solve/lanes.h"

namespace risorius::solve {

/// The factor of one matrix.
class SparseCholesky {
  public:
    /// Only the lower triangle of A is read. Throws std::invalid_argument when A is not positive definite. The factor is
    /// computed in double and stored in the precision `kept`. With float, a solve reads half the bytes and has a relative error
    /// of about 1e-6, which is enough for a metric.
    explicit SparseCholesky(const Eigen::SparseMatrix<double>& A,
                            Precision kept = Precision::kDouble);
    ~SparseCholesky();
    SparseCholesky(SparseCholesky&&) noexcept;
    SparseCholesky& operator=(SparseCholesky&&) noexcept;

    /// X = A^-1 B, n x 3 each. X may be B. Deterministic; allocates nothing after the first call. Keeps a scratch array, so
    /// only one thread at a time may call it.
    void solve(const Points& B, Points& X) const;
    int size() const;
    long nonzeros() const;  ///< of L

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace risorius::solve
