// Collects the symmetric 3n x 3n second derivative of an energy over node positions from 3 x 3 blocks, N/m.
// Rows and columns of fixed nodes become those of the identity.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "core/types.h"

namespace risorius::solve {

class HessianBuilder {
  public:
    /// `fixed` is empty or one flag per node.
    HessianBuilder(int nodes, std::vector<char> fixed);

    int nodes() const { return nodes_; }

    /// Forgets the values and keeps the memory; the next build() may have another pattern.
    void clear();

    /// Adds `block` at (i, j) and, when i != j, its transpose at (j, i): name each pair of nodes once.
    void add(int i, int j, const Mat3& block);
    void add_diagonal(int node, double w);  ///< w times the 3 x 3 identity

    /// Adds a symmetric 3 count x 3 count matrix (row-major) over the listed nodes, which must differ.
    void add_dense(const int* nodes, int count, const double* matrix);

    /// Lower triangle, 3n x 3n; coordinate k of node i is row 3 i + k. Valid until the next clear().
    const Eigen::SparseMatrix<double>& build();

  private:
    struct Entry {
        int row, column;
        Mat3 block;
    };
    int nodes_;
    std::vector<char> fixed_;
    std::vector<Entry> entries_;
    Eigen::SparseMatrix<double> matrix_;
};

}  // namespace risorius::solve
