// SPDX-License-Identifier: MIT
/// \file
/// Sparse Cholesky factor whose columns of similar pattern are stored together as dense panels (supernodes). The 3 x 3 blocks
/// of nodes in space make such panels everywhere.
///
///   A   symmetric, given by its lower triangle, n x n     P^T L L^T P = A,  P a nested-dissection ordering
///
/// The dense operations are in this library, because the bits of a BLAS depend on which one is installed.
#pragma once

#include <Eigen/SparseCore>
#include <memory>

namespace risorius::solve {

/// The factor of one matrix after another.
class SupernodalCholesky {
  public:
    SupernodalCholesky();
    ~SupernodalCholesky();
    SupernodalCholesky(SupernodalCholesky&&) noexcept;
    SupernodalCholesky& operator=(SupernodalCholesky&&) noexcept;

    /// A is ordered again only when its pattern differs from the last one. Groups of `block` consecutive rows belong to one
    /// node and are ordered together. Returns false when A is not positive definite or not finite; then there is no factor.
    bool factorise(const Eigen::SparseMatrix<double>& A, int block);

    /// x = A^-1 b, n each. x may be b. Keeps a scratch array, so only one thread at a time may call it.
    void solve(const double* b, double* x) const;

    long nonzeros() const;   ///< of the panels
    long orderings() const;  ///< number of times the pattern was new

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace risorius::solve
