#include "solve/block_matrix.h"

#include <Eigen/LU>
#include <algorithm>

namespace risorius::solve {

namespace {

FloatRow times(const Block& a, const FloatRow& x) {
    return a.column[0] * x[0] + a.column[1] * x[1] + a.column[2] * x[2];
}

}  // namespace

BlockMatrix::BlockMatrix(int nodes, const std::vector<std::vector<int>>& cliques) {
    const auto n = static_cast<std::size_t>(nodes);
    std::vector<std::vector<std::int32_t>> rows(n);
    for (std::size_t i = 0; i < n; ++i) rows[i].push_back(static_cast<std::int32_t>(i));
    for (const std::vector<int>& clique : cliques)
        for (const int i : clique)
            rows[static_cast<std::size_t>(i)].insert(rows[static_cast<std::size_t>(i)].end(),
                                                     clique.begin(), clique.end());
    row_begin_.push_back(0);
    for (std::size_t i = 0; i < n; ++i) {
        std::sort(rows[i].begin(), rows[i].end());
        rows[i].erase(std::unique(rows[i].begin(), rows[i].end()), rows[i].end());
        const auto own =
            std::lower_bound(rows[i].begin(), rows[i].end(), static_cast<std::int32_t>(i));
        diagonal_.push_back(row_begin_.back() + static_cast<std::int32_t>(own - rows[i].begin()));
        column_.insert(column_.end(), rows[i].begin(), rows[i].end());
        row_begin_.push_back(static_cast<std::int32_t>(column_.size()));
        rows[i] = {};
    }
    blocks_.assign(column_.size() + 1, Block{});
    inverse_.assign(n, Block{});
}

int BlockMatrix::slot(int i, int j) const {
    const auto begin = column_.begin() + row_begin_[static_cast<std::size_t>(i)];
    const auto end = column_.begin() + row_begin_[static_cast<std::size_t>(i) + 1];
    const auto at = std::lower_bound(begin, end, j);
    return at != end && *at == j ? static_cast<int>(at - column_.begin()) : -1;
}

void BlockMatrix::set_zero() { std::fill(blocks_.begin(), blocks_.end(), Block{}); }

void BlockMatrix::finish() {
    for (int i = 0; i < size(); ++i) {
        const Block& d = diagonal(i);
        Mat3 m;
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c) m(r, c) = static_cast<double>(d.column[c][r]);
        const Mat3 inverse = m.inverse();
        for (int c = 0; c < 3; ++c)
            for (int r = 0; r < 3; ++r)
                inverse_[static_cast<std::size_t>(i)].column[c][r] =
                    static_cast<float>(inverse(r, c));
    }
}

void BlockMatrix::forward_from_zero(const FloatPoints& b, FloatPoints& x, FloatPoints& r) const {
    const std::size_t n = diagonal_.size();
    x.resize(n);
    r.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        FloatRow sum = b[i];
        for (std::int32_t k = row_begin_[i]; k < diagonal_[i]; ++k)
            sum -= times(blocks_[static_cast<std::size_t>(k)],
                         x[static_cast<std::size_t>(column_[static_cast<std::size_t>(k)])]);
        x[i] = times(inverse_[i], sum);
    }
    // b - (L + D) x = 0 now, so only the upper half is left
    for (std::size_t i = 0; i < n; ++i) {
        FloatRow even{}, odd{};
        std::int32_t k = diagonal_[i] + 1;
        for (; k + 1 < row_begin_[i + 1]; k += 2) {
            const auto at = static_cast<std::size_t>(k);
            even -= times(blocks_[at], x[static_cast<std::size_t>(column_[at])]);
            odd -= times(blocks_[at + 1], x[static_cast<std::size_t>(column_[at + 1])]);
        }
        if (k < row_begin_[i + 1])
            even -= times(blocks_[static_cast<std::size_t>(k)],
                          x[static_cast<std::size_t>(column_[static_cast<std::size_t>(k)])]);
        r[i] = even + odd;
    }
}

void BlockMatrix::forward(const FloatPoints& b, FloatPoints& x) const {
    for (std::size_t i = 0; i < diagonal_.size(); ++i) {
        FloatRow sum = b[i];
        for (std::int32_t k = row_begin_[i]; k < row_begin_[i + 1]; ++k) {
            if (k == diagonal_[i]) continue;
            const auto at = static_cast<std::size_t>(k);
            sum -= times(blocks_[at], x[static_cast<std::size_t>(column_[at])]);
        }
        x[i] = times(inverse_[i], sum);
    }
}

void BlockMatrix::backward(const FloatPoints& b, FloatPoints& x) const {
    for (std::size_t i = diagonal_.size(); i-- > 0;) {
        // What was found last is needed last: lower and upper neighbours are summed apart
        FloatRow low{}, high{};
        for (std::int32_t k = row_begin_[i]; k < diagonal_[i]; ++k) {
            const auto at = static_cast<std::size_t>(k);
            low += times(blocks_[at], x[static_cast<std::size_t>(column_[at])]);
        }
        for (std::int32_t k = row_begin_[i + 1] - 1; k > diagonal_[i]; --k) {
            const auto at = static_cast<std::size_t>(k);
            high += times(blocks_[at], x[static_cast<std::size_t>(column_[at])]);
        }
        x[i] = times(inverse_[i], b[i] - (low + high));
    }
}

void BlockMatrix::residual(const FloatPoints& b, const FloatPoints& x, FloatPoints& r) const {
    r.resize(diagonal_.size());
    for (std::size_t i = 0; i < diagonal_.size(); ++i) {
        FloatRow sum = b[i];
        for (std::int32_t k = row_begin_[i]; k < row_begin_[i + 1]; ++k) {
            const auto at = static_cast<std::size_t>(k);
            sum -= times(blocks_[at], x[static_cast<std::size_t>(column_[at])]);
        }
        r[i] = sum;
    }
}

}  // namespace risorius::solve
