// SPDX-License-Identifier: MIT
// Assembly of 3 x 3 blocks into a symmetric sparse matrix. The places of the last assembly are kept.
#include "risorius/solve/hessian_builder.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace risorius::solve {

HessianBuilder::HessianBuilder(int nodes, std::vector<char> fixed)
    : nodes_(nodes), fixed_(std::move(fixed)) {
    if (fixed_.empty()) fixed_.assign(static_cast<std::size_t>(nodes), 0);
    assert(static_cast<int>(fixed_.size()) == nodes);
    renew_pattern();
}

void HessianBuilder::clear() {
    used_ = 0;
    new_blocks_.clear();
    std::fill(blocks_.value.begin(), blocks_.value.end(), Mat3::Zero());
}

int HessianBuilder::find(int row, int column) const {
    const auto first = blocks_.row.begin() + blocks_.begin[static_cast<std::size_t>(column)];
    const auto last = blocks_.row.begin() + blocks_.begin[static_cast<std::size_t>(column) + 1];
    const auto found = std::lower_bound(first, last, row);
    return found != last && *found == row ? static_cast<int>(found - blocks_.row.begin()) : -1;
}

void HessianBuilder::add(int i, int j, const Mat3& block) {
    assert(i >= 0 && i < nodes_ && j >= 0 && j < nodes_);
    if (fixed_[static_cast<std::size_t>(i)] || fixed_[static_cast<std::size_t>(j)]) return;
    const int row = std::max(i, j), column = std::min(i, j);

    if (used_ == places_.size()) places_.push_back({-1, -1, 0});
    Place& place = places_[used_++];
    if (place.row != row || place.column != column || place.slot < 0) {
        const int slot = find(row, column);
        place = {row, column, slot >= 0 ? slot : -1 - static_cast<int>(new_blocks_.size())};
        if (slot < 0) new_blocks_.emplace_back(Mat3::Zero());
    }
    Mat3& sum = place.slot >= 0 ? blocks_.value[static_cast<std::size_t>(place.slot)]
                                : new_blocks_[static_cast<std::size_t>(-1 - place.slot)];
    if (i >= j)
        sum += block;
    else
        sum += block.transpose();
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

// Builds the pattern of the pairs that were added since clear(), and of every diagonal block. Values move along.
void HessianBuilder::renew_pattern() {
    places_.resize(used_);
    std::vector<int> count(static_cast<std::size_t>(nodes_) + 1, 0);
    // Most pairs are in the pattern already, which is sorted
    std::vector<char> used(blocks_.row.size(), 0);
    std::vector<std::pair<int, int>> added, pairs;  // column, row
    for (int i = 0; i < nodes_; ++i) added.emplace_back(i, i);
    for (const Place& place : places_)
        if (place.slot >= 0)
            used[static_cast<std::size_t>(place.slot)] = 1;
        else
            added.emplace_back(place.column, place.row);
    std::sort(added.begin(), added.end());
    pairs.reserve(blocks_.row.size() + added.size());
    auto next = added.begin();
    for (int j = 0; j < blocks_.nodes(); ++j)
        for (int k = blocks_.begin[static_cast<std::size_t>(j)];
             k < blocks_.begin[static_cast<std::size_t>(j) + 1]; ++k) {
            if (!used[static_cast<std::size_t>(k)]) continue;
            const std::pair<int, int> pair{j, blocks_.row[static_cast<std::size_t>(k)]};
            while (next != added.end() && *next < pair) pairs.push_back(*next++);
            pairs.push_back(pair);
        }
    pairs.insert(pairs.end(), next, added.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());

    const SymmetricBlocks before = std::move(blocks_);
    blocks_.begin.assign(static_cast<std::size_t>(nodes_) + 1, 0);
    blocks_.row.clear();
    blocks_.row.reserve(pairs.size());
    for (const auto& [column, row] : pairs) {
        ++blocks_.begin[static_cast<std::size_t>(column) + 1];
        blocks_.row.push_back(row);
    }
    for (std::size_t j = 0; j < static_cast<std::size_t>(nodes_); ++j)
        blocks_.begin[j + 1] += blocks_.begin[j];
    blocks_.value.assign(pairs.size(), Mat3::Zero());

    // Each old or new sum is moved once, by the first call for its pair.
    std::vector<char> moved(pairs.size(), 0);
    for (Place& place : places_) {
        const int slot = find(place.row, place.column);
        const auto to = static_cast<std::size_t>(slot);
        if (place.slot < 0)
            blocks_.value[to] += new_blocks_[static_cast<std::size_t>(-1 - place.slot)];
        else if (!moved[to])
            blocks_.value[to] += before.value[static_cast<std::size_t>(place.slot)];
        if (place.slot >= 0) moved[to] = 1;
        place.slot = slot;
    }
    new_blocks_.clear();
    matrix_has_pattern_ = false;
}

const SymmetricBlocks& HessianBuilder::build_blocks() {
    if (!new_blocks_.empty()) renew_pattern();
    for (int i = 0; i < nodes_; ++i)
        if (fixed_[static_cast<std::size_t>(i)])
            blocks_.value[static_cast<std::size_t>(blocks_.begin[static_cast<std::size_t>(i)])] =
                Mat3::Identity();
    return blocks_;
}

const Eigen::SparseMatrix<double>& HessianBuilder::build() {
    build_blocks();
    if (!matrix_has_pattern_) {
        std::vector<int> sizes(static_cast<std::size_t>(3 * nodes_));
        for (int j = 0; j < nodes_; ++j)
            for (int c = 0; c < 3; ++c)
                sizes[static_cast<std::size_t>(3 * j + c)] =
                    3 * (blocks_.begin[static_cast<std::size_t>(j) + 1] -
                         blocks_.begin[static_cast<std::size_t>(j)]) -
                    c;
        matrix_.resize(3 * nodes_, 3 * nodes_);
        matrix_.reserve(sizes);
        matrix_.makeCompressed();
        int total = 0;
        for (int column = 0; column < 3 * nodes_; ++column) {
            matrix_.outerIndexPtr()[column] = total;
            total += sizes[static_cast<std::size_t>(column)];
        }
        matrix_.outerIndexPtr()[3 * nodes_] = total;
        matrix_.resizeNonZeros(total);
    }
    int* row = matrix_.innerIndexPtr();
    double* value = matrix_.valuePtr();
    for (int j = 0; j < nodes_; ++j) {
        const int first = blocks_.begin[static_cast<std::size_t>(j)];
        const int last = blocks_.begin[static_cast<std::size_t>(j) + 1];
        for (int c = 0; c < 3; ++c) {
            for (int k = first; k < last; ++k) {
                const Mat3& block = blocks_.value[static_cast<std::size_t>(k)];
                for (int r = k == first ? c : 0; r < 3; ++r) {
                    *value++ = block(r, c);
                    if (!matrix_has_pattern_)
                        *row++ = 3 * blocks_.row[static_cast<std::size_t>(k)] + r;
                }
            }
        }
    }
    matrix_has_pattern_ = true;
    return matrix_;
}

}  // namespace risorius::solve
