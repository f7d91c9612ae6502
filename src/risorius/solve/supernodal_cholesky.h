// SPDX-License-Identifier: MIT
/// \file
/// Sparse Cholesky factor whose columns of like pattern are kept together as dense panels (supernodes): the 3 x 3 blocks of
/// nodes in space make such panels everywhere.
///
///   A   symmetric, given by its lower triangle, n x n     P^T L L^T P = A,  P a nested-dissection ordering
///
/// The dense work is done by own kernels: the bits of a BLAS depend on the library installed.
#pragma once

#include <Eigen/SparseCore>
#include <memory>

namespace risorius::solve {

class SupernodalCholesky {
  public:
    SupernodalCholesky();
    ~SupernodalCholesky();
    SupernodalCholesky(SupernodalCholesky&&) noexcept;
    SupernodalCholesky& operator=(SupernodalCholesky&&) noexcept;

    /// Orders A anew only when its pattern differs from the last one's. `block` rows in a row belong to one node and are
    /// ordered together. False when A is not positive definite or not finite: then there is no factor.
    bool factorise(const Eigen::SparseMatrix<double>& A, int block);

    /// x = A^-1 b, n each; x may be b. One thread at a time: it keeps a scratch array.
    void solve(const double* b, double* x) const;

    long nonzeros() const;   ///< of the panels
    long orderings() const;  ///< how often the pattern was new

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace risorius::solve
