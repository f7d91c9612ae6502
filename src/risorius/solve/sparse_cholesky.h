// SPDX-License-Identifier: MIT
/// \file
/// Sparse Cholesky factor of a constant n x n matrix, solved for three right-hand sides at once.
///
///   A   symmetric positive definite, n x n
///   L   its factor after a nested-dissection ordering P, A = P^T L L^T P
#pragma once

#include <Eigen/SparseCore>
#include <memory>

#include "risorius/core/types.h"
#include "risorius/solve/lanes.h"

namespace risorius::solve {

class SparseCholesky {
  public:
    /// Only the lower triangle of A is read. Throws std::invalid_argument when A is not positive
    /// definite. The factor is found in double and kept in `kept`: in float, half the bytes are read per solution, which is
    /// good to 1e-6 of its size then: enough for a metric.
    explicit SparseCholesky(const Eigen::SparseMatrix<double>& A,
                            Precision kept = Precision::kDouble);
    ~SparseCholesky();
    SparseCholesky(SparseCholesky&&) noexcept;
    SparseCholesky& operator=(SparseCholesky&&) noexcept;

    /// X = A^-1 B, n x 3 each; X may be B. Deterministic, no allocation after the first call. One thread at a time: it
    /// keeps a scratch array.
    void solve(const Points& B, Points& X) const;
    int size() const;
    long nonzeros() const;  ///< of L

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace risorius::solve
