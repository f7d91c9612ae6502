// SPDX-License-Identifier: MIT
/// \file
/// Sparse L D L^T factor of a symmetric matrix that may be indefinite.
///
///   A   symmetric, given by its lower triangle; n x n over nodes, or 3n x 3n over their coordinates
///   D   diagonal; it has as many negative entries as A has negative eigenvalues (Sylvester's law of inertia)
#pragma once

#include <Eigen/SparseCore>
#include <memory>

namespace risorius::solve {

/// What the signs of D say about A.
enum class Definiteness {
    kPositive,
    kIndefinite,  ///< there is a factor, but a Newton step may not be a descent direction
    kSingular     ///< singular or not finite: there is no factor
};

/// Factors one matrix after another and solves with the last one.
class SymmetricFactor {
  public:
    SymmetricFactor();
    ~SymmetricFactor();
    SymmetricFactor(SymmetricFactor&&) noexcept;
    SymmetricFactor& operator=(SymmetricFactor&&) noexcept;

    /// Factors A. Its rows are ordered again only when its pattern differs from the last one. Groups of `block` consecutive
    /// rows (1 or 3) belong to one node and are ordered together.
    Definiteness factorise(const Eigen::SparseMatrix<double>& A, int block);

    /// Computes x = A^-1 b for `columns` right-hand sides; b and x are n x columns, row-major. x may be b. The last factorise()
    /// must have given a factor.
    void solve(const double* b, double* x, int columns) const;

    long nonzeros() const;   ///< number of nonzeros of L
    long orderings() const;  ///< number of times that rows were ordered

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace risorius::solve
