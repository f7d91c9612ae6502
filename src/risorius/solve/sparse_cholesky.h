// SPDX-License-Identifier: MIT
/// \file
/// Sparse Cholesky factor of a constant n x n matrix. It solves for three right-hand sides (x, y and z) at once.
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
    /// computed in double and stored in the precision `kept`. With kSingle, a solve reads half the bytes and has a relative
    /// error of about 1e-6, which is small enough for a metric.
    explicit SparseCholesky(const Eigen::SparseMatrix<double>& A,
                            Precision kept = Precision::kDouble);
    ~SparseCholesky();
    SparseCholesky(SparseCholesky&&) noexcept;
    SparseCholesky& operator=(SparseCholesky&&) noexcept;

    /// Computes X = A^-1 B, n x 3 each. X may be B. The result is the same in every run. The function allocates nothing after
    /// the first call. It uses a scratch array, so only one thread at a time may call it.
    void solve(const Points& B, Points& X) const;
    int size() const;
    long nonzeros() const;  ///< number of nonzeros of L

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace risorius::solve
