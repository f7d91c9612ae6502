#include "solve/block_matrix.h"

#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cstring>

namespace risorius::solve {

namespace {

FloatRow load(const float* from) {
    FloatRow row;
    std::memcpy(&row, from, sizeof row);
    return row;
}

/// A x. The fourth lane holds what follows in memory, times x; nobody reads it.
FloatRow times(const float* a, const FloatRow& x) {
    return load(a) * x[0] + load(a + 3) * x[1] + load(a + 6) * x[2];
}

/// A^T x
FloatRow transposed_times(const float* a, const FloatRow& x) {
    const FloatRow p0 = load(a) * x, p1 = load(a + 3) * x, p2 = load(a + 6) * x;
    // Columns summed: lanes 0..2 of each, transposed
    const FloatRow xy01 = __builtin_shufflevector(p0, p1, 0, 4, 1, 5);  // p0x p1x p0y p1y
    const FloatRow z01 = __builtin_shufflevector(p0, p1, 2, 6, 2, 6);
    const FloatRow x012 = __builtin_shufflevector(xy01, p2, 0, 1, 4, 4);
    const FloatRow y012 = __builtin_shufflevector(xy01, p2, 2, 3, 5, 5);
    const FloatRow z012 = __builtin_shufflevector(z01, p2, 0, 1, 6, 6);
    return (x012 + y012) + z012;
}

FloatRow times(const Block& a, const FloatRow& x) {
    return a.column[0] * x[0] + a.column[1] * x[1] + a.column[2] * x[2];
}

}  // namespace

BlockMatrix::BlockMatrix(int nodes, const std::vector<std::vector<int>>& cliques) {
    const auto n = static_cast<std::size_t>(nodes);
    std::vector<std::vector<std::int32_t>> rows(n);
    for (const std::vector<int>& clique : cliques)
        for (const int i : clique)
            for (const int j : clique)
                if (i < j) rows[static_cast<std::size_t>(i)].push_back(j);
    row_begin_.push_back(0);
    for (std::vector<std::int32_t>& row : rows) {
        std::sort(row.begin(), row.end());
        row.erase(std::unique(row.begin(), row.end()), row.end());
        column_.insert(column_.end(), row.begin(), row.end());
        row_begin_.push_back(static_cast<std::int32_t>(column_.size()));
        row = {};
    }
    values_.assign(9 * (column_.size() + 1) + 4, 0.0f);
    diagonal_.assign(n, Block{});
    inverse_.assign(n, Block{});
}

int BlockMatrix::slot(int i, int j) const {
    assert(i < j);
    const auto begin = column_.begin() + row_begin_[static_cast<std::size_t>(i)];
    const auto end = column_.begin() + row_begin_[static_cast<std::size_t>(i) + 1];
    const auto at = std::lower_bound(begin, end, j);
    return at != end && *at == j ? static_cast<int>(at - column_.begin()) : -1;
}

void BlockMatrix::set_zero() {
    std::fill(values_.begin(), values_.end(), 0.0f);
    std::fill(diagonal_.begin(), diagonal_.end(), Block{});
}

void BlockMatrix::add(int slot, const Block& block) {
    // The fourth lane adds zero to what follows.
    float* const to = values_.data() + 9 * static_cast<std::size_t>(slot);
    for (int c = 0; c < 3; ++c) {
        const FloatRow sum = load(to + 3 * c) + block.column[c];
        std::memcpy(to + 3 * c, &sum, sizeof sum);
    }
}

Block BlockMatrix::block(int slot) const {
    Block block{};
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r)
            block.column[c][r] =
                values_[9 * static_cast<std::size_t>(slot) + static_cast<std::size_t>(3 * c + r)];
    return block;
}

void BlockMatrix::finish() {
    for (std::size_t i = 0; i < diagonal_.size(); ++i) {
        const Block& d = diagonal_[i];
        Mat3 m;
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c) m(r, c) = static_cast<double>(d.column[c][r]);
        const Mat3 inverse = m.inverse();
        for (int c = 0; c < 3; ++c)
            for (int r = 0; r < 3; ++r)
                inverse_[i].column[c][r] = static_cast<float>(inverse(r, c));
    }
}

void BlockMatrix::forward_from_zero(const FloatPoints& b, FloatPoints& x, FloatPoints& r) const {
    const std::size_t n = diagonal_.size();
    x.resize(n);
    r = b;
    const std::int32_t* const column = column_.data();
    for (std::size_t i = 0; i < n; ++i) {
        const FloatRow xi = x[i] = times(inverse_[i], r[i]);
        const auto end = static_cast<std::size_t>(row_begin_[i + 1]);
        for (auto k = static_cast<std::size_t>(row_begin_[i]); k < end; ++k)
            r[static_cast<std::size_t>(column[k])] -= transposed_times(values_.data() + 9 * k, xi);
    }
    // b - (D + L) x = 0 now, which leaves the upper half
    for (std::size_t i = 0; i < n; ++i) {
        FloatRow even{}, odd{};
        const auto end = static_cast<std::size_t>(row_begin_[i + 1]);
        auto k = static_cast<std::size_t>(row_begin_[i]);
        for (; k + 1 < end; k += 2) {
            even -= times(values_.data() + 9 * k, x[static_cast<std::size_t>(column[k])]);
            odd -= times(values_.data() + 9 * k + 9, x[static_cast<std::size_t>(column[k + 1])]);
        }
        if (k < end) even -= times(values_.data() + 9 * k, x[static_cast<std::size_t>(column[k])]);
        r[i] = even + odd;
    }
}

void BlockMatrix::forward(const FloatPoints& b, FloatPoints& x, FloatPoints& r) const {
    const std::size_t n = diagonal_.size();
    const std::int32_t* const column = column_.data();
    r = b;
    for (std::size_t i = 0; i < n; ++i) {
        FloatRow above{};
        const auto begin = static_cast<std::size_t>(row_begin_[i]);
        const auto end = static_cast<std::size_t>(row_begin_[i + 1]);
        for (auto k = begin; k < end; ++k)
            above += times(values_.data() + 9 * k, x[static_cast<std::size_t>(column[k])]);
        const FloatRow xi = x[i] = times(inverse_[i], r[i] - above);
        r[i] = above;  // U x of before
        for (auto k = begin; k < end; ++k)
            r[static_cast<std::size_t>(column[k])] -= transposed_times(values_.data() + 9 * k, xi);
    }
    // b - A x = U (x before - x)
    for (std::size_t i = 0; i < n; ++i)
        for (auto k = static_cast<std::size_t>(row_begin_[i]);
             k < static_cast<std::size_t>(row_begin_[i + 1]); ++k)
            r[i] -= times(values_.data() + 9 * k, x[static_cast<std::size_t>(column[k])]);
}

void BlockMatrix::backward(const FloatPoints& b, FloatPoints& x, FloatPoints& r) const {
    const std::size_t n = diagonal_.size();
    const std::int32_t* const column = column_.data();
    r = b;
    for (std::size_t i = 0; i < n; ++i)
        for (auto k = static_cast<std::size_t>(row_begin_[i]);
             k < static_cast<std::size_t>(row_begin_[i + 1]); ++k)
            r[static_cast<std::size_t>(column[k])] -=
                transposed_times(values_.data() + 9 * k, x[i]);
    for (std::size_t i = n; i-- > 0;) {
        // What was found last is needed last
        FloatRow even{}, odd{};
        auto k = static_cast<std::size_t>(row_begin_[i + 1]);
        const auto begin = static_cast<std::size_t>(row_begin_[i]);
        for (; k >= begin + 2; k -= 2) {
            even += times(values_.data() + 9 * (k - 1), x[static_cast<std::size_t>(column[k - 1])]);
            odd += times(values_.data() + 9 * (k - 2), x[static_cast<std::size_t>(column[k - 2])]);
        }
        if (k > begin)
            odd += times(values_.data() + 9 * begin, x[static_cast<std::size_t>(column[begin])]);
        x[i] = times(inverse_[i], (r[i] - even) - odd);
    }
}

}  // namespace risorius::solve
