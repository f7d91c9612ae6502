// SPDX-License-Identifier: MIT
/// \file
/// Sparse Cholesky factor in which columns with similar patterns are stored together as dense panels (supernodes). Matrices of
/// 3 x 3 blocks have such columns everywhere.
///
///   A   symmetric, given by its lower triangle, n x n     P^T L L^T P = A,  P a nested-dissection ordering
///
/// The dense operations are in this library (detail/dense_panels.h) and not from a BLAS, because the last bits of its results
/// depend on which BLAS is installed.
#pragma once

#include <Eigen/SparseCore>
#include <memory>

#include "risorius/solve/lanes.h"

namespace risorius::solve {

/// Factors one matrix after another and solves with the last one.
class SupernodalCholesky {
  public:
    SupernodalCholesky();
    ~SupernodalCholesky();
    SupernodalCholesky(SupernodalCholesky&&) noexcept;
    SupernodalCholesky& operator=(SupernodalCholesky&&) noexcept;

    /// Orders the rows for all matrices of the size of A that come, whose patterns differ from that of A by little: nested dissection
    /// takes as long as several factorisations. Groups of `block` consecutive rows belong to one node and are ordered together.
    void order_like(const Eigen::SparseMatrix<double>& A, int block);

    /// Factors A. Its pattern is analysed again only when it differs from the last one. Without order_like(), its rows are ordered
    /// then, too. Groups of `block` consecutive
    /// rows belong to one node and are ordered together. `kept` is the precision of the factor and of its solutions: single takes
    /// half of the time, and serves as a metric. Returns false when A is not positive definite or not finite in this precision; then
    /// there is no factor.
    bool factorise(const Eigen::SparseMatrix<double>& A, int block,
                   Precision kept = Precision::kDouble);

    /// Computes x = A^-1 b, n numbers each. x may be b. It uses a scratch array, so only one thread at a time may call it.
    void solve(const double* b, double* x) const;

    long nonzeros() const;   ///< number of entries of the panels
    long orderings() const;  ///< number of times that rows were ordered by nested dissection

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace risorius::solve
