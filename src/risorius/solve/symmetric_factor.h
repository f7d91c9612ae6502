// SPDX-License-Identifier: MIT
/// \file
/// Sparse L D L^T factor of a symmetric matrix that may be indefinite.
///
///   A   symmetric, given by its lower triangle; n x n over nodes, or 3n x 3n over their coordinates
///   D   its signs tell those of the eigenvalues of A (Sylvester's law of inertia)
#pragma once

#include <Eigen/SparseCore>
#include <memory>

namespace risorius::solve {

enum class Definiteness {
    kPositive,
    kIndefinite,  ///< factored: solves work, but a solution is no descent direction
    kSingular     ///< or not finite: no factor
};

class SymmetricFactor {
  public:
    SymmetricFactor();
    ~SymmetricFactor();
    SymmetricFactor(SymmetricFactor&&) noexcept;
    SymmetricFactor& operator=(SymmetricFactor&&) noexcept;

    /// Orders A anew only when its pattern differs from the last one's. `block` rows in a row belong to one node (1 or 3)
    /// and are ordered together.
    Definiteness factorise(const Eigen::SparseMatrix<double>& A, int block);

    /// x = A^-1 b for `columns` right-hand sides, n x columns row-major each; x may be b. The factor must not be singular.
    void solve(const double* b, double* x, int columns) const;

    long nonzeros() const;   ///< of L
    long orderings() const;  ///< how often the pattern was new

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace risorius::solve
