// SPDX-License-Identifier: MIT
/// \file
/// Assembles the symmetric 3n x 3n second derivative of an energy over node positions from 3 x 3 blocks, N/m. Rows and columns
/// of fixed nodes become those of the identity.
///
/// Second derivatives are assembled many times over the same pairs of nodes in the same order. So the builder remembers the
/// place of each call's block, and searches only where the order has changed.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::solve {

/// The lower triangle of a symmetric matrix of 3 x 3 blocks, stored by columns; one row and one column per node. Each column
/// starts with its diagonal block, and rows ascend.
struct SymmetricBlocks {
    std::vector<int> begin;  ///< index of the first block of each column, then the number of blocks
    std::vector<int> row;    ///< row of each block
    std::vector<Mat3> value;  ///< the blocks, N/m

    int nodes() const { return static_cast<int>(begin.size()) - 1; }
};

/// Assembles one second derivative after another.
class HessianBuilder {
  public:
    /// `fixed` is empty or one flag per node.
    HessianBuilder(int nodes, std::vector<char> fixed);

    int nodes() const { return nodes_; }
    const std::vector<char>& fixed() const { return fixed_; }  ///< one flag per node

    /// Forgets the values and keeps the memory. The next build() may have another pattern.
    void clear();

    /// Adds `block` at (i, j) and, when i != j, its transpose at (j, i). A pair of nodes must always be added in the same
    /// order.
    void add(int i, int j, const Mat3& block);
    void add_diagonal(int node, double w);  ///< w times the 3 x 3 identity

    /// Adds a symmetric 3 count x 3 count matrix (row-major) over the listed nodes, which must be distinct.
    void add_dense(const int* nodes, int count, const double* matrix);

    /// The lower triangle, 3n x 3n. Coordinate k of node i is row 3 i + k. Valid until the next clear().
    const Eigen::SparseMatrix<double>& build();

    /// The same matrix in blocks, without a copy. Valid until the next clear().
    const SymmetricBlocks& build_blocks();

  private:
    struct Place {
        int row, column;
        /// Index in blocks_.value; for pairs that are new to the pattern, -1 - index in new_blocks_.
        int slot;
    };
    int find(int row, int column) const;  ///< slot, or -1 when the pattern does not have it
    void renew_pattern();

    int nodes_;
    std::vector<char> fixed_;
    /// Places of the blocks in the order of the calls. Those from used_ on are from the previous assembly.
    std::vector<Place> places_;
    std::size_t used_ = 0;
    std::vector<Mat3> new_blocks_;
    SymmetricBlocks blocks_;
    bool matrix_has_pattern_ = false;
    Eigen::SparseMatrix<double> matrix_;
};

}  // namespace risorius::solve
