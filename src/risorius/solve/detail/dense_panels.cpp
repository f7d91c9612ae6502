// SPDX-License-Identifier: MIT
#include "risorius/solve/detail/dense_panels.h"

#include <algorithm>
#include <cmath>

#include "risorius/solve/lanes.h"

namespace risorius::solve::detail {

namespace {

constexpr int kPanelBlock = 32;  // columns of a panel that are factored together

template <class Real>
using Lane = typename LanesOf<Real>::Lane;
template <class Real>
constexpr int kTileRows = 2 * LanesOf<Real>::kWidth;  // of C, kept in registers
static_assert(kTileRows<float> <= kReadBeyond && kTileRows<double> <= kReadBeyond);

template <class Real>
Lane<Real> load(const Real* p) {
    Lane<Real> out;
    __builtin_memcpy(&out, p, sizeof out);
    return out;
}
template <class Real>
void store(Real* p, const Lane<Real>& v) {
    __builtin_memcpy(p, &v, sizeof v);
}

/// A tile of C with two lanes of rows. Nodes have three columns, so most products have a multiple of three: six columns fill the
/// registers, three are what is left over.
template <int Columns, class Real>
void tile(const Real* a, int a_stride, const Real* b, int b_stride, int k, Real* c, int c_stride) {
    constexpr int kWidth = LanesOf<Real>::kWidth;
    Lane<Real> s[Columns][2]{};
    for (int p = 0; p < k; ++p) {
        const Lane<Real> a0 = load(a), a1 = load(a + kWidth);
        for (int j = 0; j < Columns; ++j) {
            s[j][0] += a0 * b[j];
            s[j][1] += a1 * b[j];
        }
        a += a_stride;
        b += b_stride;
    }
    for (int j = 0; j < Columns; ++j) {
        store(c + static_cast<long>(j) * c_stride, s[j][0]);
        store(c + static_cast<long>(j) * c_stride + kWidth, s[j][1]);
    }
}

/// Subtracts w[j] times column j, and so on, from the rows of w below the panel's own.
template <int Columns, class Real>
void subtract_columns(const Real* panel, int tall, int width, int j, Real* w) {
    constexpr int kWidth = LanesOf<Real>::kWidth;
    const Real* const own = panel + static_cast<long>(j) * tall;
    for (int i = width; i < tall; i += kWidth) {
        Lane<Real> sum = load(w + i);
        for (int c = 0; c < Columns; ++c)
            sum -= w[j + c] * load(own + static_cast<long>(c) * tall + i);
        store(w + i, sum);
    }
}

/// Sum of the lanes, in a fixed order.
double sum_of(const Lanes& a) { return sum_lanes(a); }
float sum_of(const FloatLanes& a) {
    const FloatPoint half =
        __builtin_shufflevector(a, a, 0, 1, 2, 3) + __builtin_shufflevector(a, a, 4, 5, 6, 7);
    return (half[0] + half[1]) + (half[2] + half[3]);
}

}  // namespace

template <class Real>
int stored_rows(int m) {
    return (m + kTileRows<Real> - 1) / kTileRows<Real> * kTileRows<Real>;
}

template <class Real>
void product(const Real* a, int a_stride, const Real* b, int b_stride, int m, int n, int k,
             Real* c) {
    const int c_stride = stored_rows<Real>(m);
    const auto columns = [&](int j, auto tile_of) {
        for (int i = j - j % kTileRows<Real>; i < m; i += kTileRows<Real>)
            tile_of(a + i, a_stride, b + j, b_stride, k, c + static_cast<long>(j) * c_stride + i,
                    c_stride);
    };
    int j = 0;
    for (; j + 6 <= n; j += 6) columns(j, tile<6, Real>);
    for (; j + 3 <= n; j += 3) columns(j, tile<3, Real>);
    for (; j < n; ++j) columns(j, tile<1, Real>);
}

template <class Real>
bool factorise_panel(Real* panel, int tall, int width, std::vector<Real>& scratch) {
    const auto column = [&](int j) { return panel + static_cast<long>(j) * tall; };
    for (int from = 0; from < width; from += kPanelBlock) {
        const int to = std::min(width, from + kPanelBlock);
        if (from > 0) {  // what the earlier columns subtract from this block
            const int m = tall - from, n = to - from, stride = stored_rows<Real>(m);
            scratch.resize(static_cast<std::size_t>(stride) * static_cast<std::size_t>(n));
            product(panel + from, tall, panel + from, tall, m, n, from, scratch.data());
            for (int j = 0; j < n; ++j) {
                Real* const out = column(from + j) + from;
                const Real* const change = scratch.data() + static_cast<long>(j) * stride;
                for (int i = j; i < m; ++i) out[i] -= change[i];
            }
        }
        for (int j = from; j < to; ++j) {
            Real* const own = column(j);
            for (int p = from; p < j; ++p) {
                const Real* const before = column(p);
                const Real factor = before[j];
                for (int i = j; i < tall; ++i) own[i] -= factor * before[i];
            }
            if (!(own[j] > 0) || !std::isfinite(own[j])) return false;
            const Real root = std::sqrt(own[j]), inverse = 1 / root;
            own[j] = root;
            for (int i = j + 1; i < tall; ++i) own[i] *= inverse;
        }
    }
    return true;
}

template <class Real>
void eliminate(const Real* panel, int tall, int width, Real* w) {
    for (int j = 0; j < width; ++j) {
        const Real* const own = panel + static_cast<long>(j) * tall;
        const Real x = w[j] / own[j];
        w[j] = x;
        for (int i = j + 1; i < width; ++i) w[i] -= x * own[i];
    }
    // The rows below, by three columns at a time
    int j = 0;
    for (; j + 3 <= width; j += 3) subtract_columns<3>(panel, tall, width, j, w);
    for (; j < width; ++j) subtract_columns<1>(panel, tall, width, j, w);
}

template <class Real>
void substitute(const Real* panel, int tall, int width, Real* w) {
    constexpr int kWidth = LanesOf<Real>::kWidth;
    std::fill(w + tall, w + tall + 2 * kWidth,
              Real(0));  // what is read beyond the panel counts nothing
    for (int j = width - 1; j >= 0; --j) {
        const Real* const own = panel + static_cast<long>(j) * tall;
        Lane<Real> even{}, odd{};
        for (int i = j + 1; i < tall; i += 2 * kWidth) {
            even += load(own + i) * load(w + i);
            odd += load(own + i + kWidth) * load(w + i + kWidth);
        }
        w[j] = (w[j] - sum_of(even + odd)) / own[j];
    }
}

template int stored_rows<double>(int);
template int stored_rows<float>(int);
template void product(const double*, int, const double*, int, int, int, int, double*);
template void product(const float*, int, const float*, int, int, int, int, float*);
template bool factorise_panel(double*, int, int, std::vector<double>&);
template bool factorise_panel(float*, int, int, std::vector<float>&);
template void eliminate(const double*, int, int, double*);
template void eliminate(const float*, int, int, float*);
template void substitute(const double*, int, int, double*);
template void substitute(const float*, int, int, float*);

}  // namespace risorius::solve::detail
