// Sparse Cholesky factor of a constant n x n matrix, solved for three right-hand sides at once.
//
//   A   symmetric positive definite, n x n      L   its factor after an AMD ordering, A = P^T L L^T
//   P
#pragma once

#include <Eigen/SparseCore>
#include <memory>

#include "core/types.h"

namespace risorius::solve {

class SparseCholesky {
  public:
    /// Only the lower triangle of A is read. Throws std::invalid_argument when A is not positive
    /// definite.
    explicit SparseCholesky(const Eigen::SparseMatrix<double>& A);
    ~SparseCholesky();
    SparseCholesky(SparseCholesky&&) noexcept;
    SparseCholesky& operator=(SparseCholesky&&) noexcept;

    /// X = A^-1 B, n x 3 each. Deterministic, no allocation after the first call.
    void solve(const Points& B, Points& X) const;
    int size() const;
    long nonzeros() const;  ///< of L

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace risorius::solve
