// SPDX-License-Identifier: MIT
/// \file
/// Assembles the metric of the quasi-Newton solver or a Laplacian, N/m: a symmetric n x n matrix with one number per pair of
/// nodes, used for x, y and z alike.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

namespace risorius::solve {

/// Assembles the matrix; n is the number of nodes.
class MetricBuilder {
  public:
    explicit MetricBuilder(int nodes);

    int nodes() const { return nodes_; }
    void add_diagonal(int node, double w);

    /// Adds w c c^T on the listed nodes. When a node is listed twice, its coefficients add up.
    void add_outer(const int* nodes, const double* coefficients, int count, double w);

    /// Adds a symmetric count x count block (row-major; only its lower triangle is read). The nodes must be distinct.
    void add_block(const int* nodes, const double* block, int count);

    /// The lower triangle. Rows and columns of fixed nodes are those of the identity. `fixed` is empty or has one flag per
    /// node.
    Eigen::SparseMatrix<double> build(const std::vector<char>& fixed) const;

  private:
    void add(int i, int j, double value);

    int nodes_;
    std::vector<Eigen::Triplet<double, int>> entries_;
};

}  // namespace risorius::solve
