#include "solve/hessian_builder.h"

#include <cassert>
#include <utility>

namespace risorius::solve {

HessianBuilder::HessianBuilder(int nodes, std::vector<char> fixed)
    : nodes_(nodes), fixed_(std::move(fixed)) {
    if (fixed_.empty()) fixed_.assign(static_cast<std::size_t>(nodes), 0);
    assert(static_cast<int>(fixed_.size()) == nodes);
}

void HessianBuilder::clear() { entries_.clear(); }

void HessianBuilder::add(int i, int j, const Mat3& block) {
    assert(i >= 0 && i < nodes_ && j >= 0 && j < nodes_);
    if (fixed_[static_cast<std::size_t>(i)] || fixed_[static_cast<std::size_t>(j)]) return;
    if (i >= j)
        entries_.push_back({i, j, block});
    else
        entries_.push_back({j, i, block.transpose()});
}

void HessianBuilder::add_diagonal(int node, double w) { add(node, node, w * Mat3::Identity()); }

void HessianBuilder::add_dense(const int* nodes, int count, const double* matrix) {
    using Block = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
    const Eigen::OuterStride<> stride(3 * count);
    for (int i = 0; i < count; ++i)
        for (int j = 0; j <= i; ++j)
            add(nodes[i], nodes[j],
                Eigen::Map<const Block, 0, Eigen::OuterStride<>>(matrix + 9 * i * count + 3 * j,
                                                                 stride));
}

const Eigen::SparseMatrix<double>& HessianBuilder::build() {
    std::vector<Eigen::Triplet<double, int>> triplets;
    triplets.reserve(entries_.size() * 9);
    for (const Entry& entry : entries_)
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c)
                if (entry.row != entry.column || r >= c)
                    triplets.emplace_back(3 * entry.row + r, 3 * entry.column + c,
                                          entry.block(r, c));
    for (int i = 0; i < nodes_; ++i)
        if (fixed_[static_cast<std::size_t>(i)])
            for (int k = 0; k < 3; ++k) triplets.emplace_back(3 * i + k, 3 * i + k, 1.0);
    matrix_.resize(3 * nodes_, 3 * nodes_);
    matrix_.setFromTriplets(triplets.begin(), triplets.end());
    return matrix_;
}

}  // namespace risorius::solve
