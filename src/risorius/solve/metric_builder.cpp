// SPDX-License-Identifier: MIT
#include "risorius/solve/metric_builder.h"

#include <cassert>
#include <utility>

namespace risorius::solve {

MetricBuilder::MetricBuilder(int nodes) : nodes_(nodes) {}

void MetricBuilder::add(int i, int j, double value) {
    assert(i >= 0 && i < nodes_ && j >= 0 && j < nodes_);
    if (i < j) std::swap(i, j);
    entries_.emplace_back(i, j, value);
}

void MetricBuilder::add_diagonal(int node, double w) { add(node, node, w); }

void MetricBuilder::add_outer(const int* nodes, const double* coefficients, int count, double w) {
    for (int a = 0; a < count; ++a) {
        for (int b = 0; b <= a; ++b) {
            const double value = w * coefficients[a] * coefficients[b];
            // An off-diagonal (a, b) stands for (b, a) too. If both are the same node, both fall on its diagonal.
            const bool meets_itself = a != b && nodes[a] == nodes[b];
            add(nodes[a], nodes[b], meets_itself ? 2 * value : value);
        }
    }
}

void MetricBuilder::add_block(const int* nodes, const double* block, int count) {
    for (int a = 0; a < count; ++a)
        for (int b = 0; b <= a; ++b) add(nodes[a], nodes[b], block[a * count + b]);
}

Eigen::SparseMatrix<double> MetricBuilder::build(const std::vector<char>& fixed) const {
    assert(fixed.empty() || static_cast<int>(fixed.size()) == nodes_);
    const auto is_fixed = [&](int node) {
        return !fixed.empty() && fixed[static_cast<std::size_t>(node)] != 0;
    };
    std::vector<Eigen::Triplet<double, int>> kept;
    kept.reserve(entries_.size() + fixed.size());
    for (const auto& entry : entries_)
        if (!is_fixed(entry.row()) && !is_fixed(entry.col())) kept.push_back(entry);
    for (int node = 0; node < nodes_; ++node)
        if (is_fixed(node)) kept.emplace_back(node, node, 1.0);
    Eigen::SparseMatrix<double> matrix(nodes_, nodes_);
    matrix.setFromTriplets(kept.begin(), kept.end());
    return matrix;
}

}  // namespace risorius::solve
