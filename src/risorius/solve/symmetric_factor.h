// SPDX-License-Identifier: MIT
/// \file
/// Sparse L D L^T factor of a symmetric matrix that may be indefinite.
///
///   A   symmetric, given by its lower triangle; n x n over nodes, or 3n x 3n over their coordinates
///   D   its signs are those of the eigenvalues of A (Sylvester's law of inertia)
#pragma once

#include <Eigen/SparseCore>
#include <memory>

namespace risorius::solve {

/// What the signs of D say about A.
enum class Definiteness {
    kPositive,
    kIndefinite,  ///< factored: solves work, but a solution need not be a descent direction
    kSingular     ///< or not finite: there is no factor
};

/// The factor of one matrix after another.
class SymmetricFactor {
  public:
    SymmetricFactor();
    ~SymmetricFactor();
    SymmetricFactor(SymmetricFactor&&) noexcept;
    SymmetricFactor& operator=(SymmetricFactor&&) noexcept;

    /// A is ordered again only when its pattern differs from the last one. Groups of `block` consecutive rows (1 or 3) belong
    /// to one node and are ordered together.
    Definiteness factorise(const Eigen::SparseMatrix<double>& A, int block);

    /// x = A^-1 b for `columns` right-hand sides, n x columns row-major each. x may be b. There must be a factor.
    void solve(const double* b, double* x, int columns) const;

    long nonzeros() const;   ///< of L
    long orderings() const;  ///< number of times the pattern was new

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace risorius::solve
