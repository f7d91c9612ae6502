// SPDX-License-Identifier: MIT
#include "risorius/solve/detail/dense_panels.h"

#include <algorithm>
#include <cmath>

#include "risorius/solve/lanes.h"

namespace risorius::solve::detail {

namespace {

constexpr int kTileRows = 8, kTileColumns = 4;  // of C, kept in registers
constexpr int kPanelBlock = 32;                 // columns of a panel that are factored together

Lanes load(const double* p) {
    Lanes out;
    __builtin_memcpy(&out, p, sizeof out);
    return out;
}
void store(double* p, const Lanes& v) { __builtin_memcpy(p, &v, sizeof v); }

/// An 8 x 4 tile of C.
void tile(const double* a, int a_stride, const double* b, int b_stride, int k, double* c,
          int c_stride) {
    Lanes s[kTileColumns][2]{};
    for (int p = 0; p < k; ++p) {
        const Lanes a0 = load(a), a1 = load(a + 4);
        for (int j = 0; j < kTileColumns; ++j) {
            s[j][0] += a0 * b[j];
            s[j][1] += a1 * b[j];
        }
        a += a_stride;
        b += b_stride;
    }
    for (int j = 0; j < kTileColumns; ++j) {
        store(c + static_cast<long>(j) * c_stride, s[j][0]);
        store(c + static_cast<long>(j) * c_stride + 4, s[j][1]);
    }
}

void edge(const double* a, int a_stride, const double* b, int b_stride, int m, int n, int k,
          double* c, int c_stride) {
    for (int j = 0; j < n; ++j) {
        double sum[kTileRows]{};
        for (int p = 0; p < k; ++p) {
            const double* const column = a + static_cast<long>(p) * a_stride;
            const double factor = b[static_cast<long>(p) * b_stride + j];
            for (int i = 0; i < m; ++i) sum[i] += column[i] * factor;
        }
        for (int i = 0; i < m; ++i) c[static_cast<long>(j) * c_stride + i] = sum[i];
    }
}

}  // namespace

void product(const double* a, int a_stride, const double* b, int b_stride, int m, int n, int k,
             double* c) {
    for (int j = 0; j < n; j += kTileColumns) {
        const int columns = std::min(kTileColumns, n - j);
        for (int i = j - j % kTileRows; i < m; i += kTileRows) {
            const int rows = std::min(kTileRows, m - i);
            double* const to = c + static_cast<long>(j) * m + i;
            if (rows == kTileRows && columns == kTileColumns)
                tile(a + i, a_stride, b + j, b_stride, k, to, m);
            else
                edge(a + i, a_stride, b + j, b_stride, rows, columns, k, to, m);
        }
    }
}

bool factorise_panel(double* panel, int tall, int width, std::vector<double>& scratch) {
    const auto column = [&](int j) { return panel + static_cast<long>(j) * tall; };
    for (int from = 0; from < width; from += kPanelBlock) {
        const int to = std::min(width, from + kPanelBlock);
        if (from > 0) {  // what the earlier columns subtract from this block
            const int m = tall - from, n = to - from;
            scratch.resize(static_cast<std::size_t>(m) * static_cast<std::size_t>(n));
            product(panel + from, tall, panel + from, tall, m, n, from, scratch.data());
            for (int j = 0; j < n; ++j) {
                double* const out = column(from + j) + from;
                const double* const change = scratch.data() + static_cast<long>(j) * m;
                for (int i = j; i < m; ++i) out[i] -= change[i];
            }
        }
        for (int j = from; j < to; ++j) {
            double* const own = column(j);
            for (int p = from; p < j; ++p) {
                const double* const before = column(p);
                const double factor = before[j];
                for (int i = j; i < tall; ++i) own[i] -= factor * before[i];
            }
            if (!(own[j] > 0) || !std::isfinite(own[j])) return false;
            const double root = std::sqrt(own[j]), inverse = 1 / root;
            own[j] = root;
            for (int i = j + 1; i < tall; ++i) own[i] *= inverse;
        }
    }
    return true;
}

void eliminate(const double* panel, int tall, int width, double* w) {
    for (int j = 0; j < width; ++j) {
        const double* const own = panel + static_cast<long>(j) * tall;
        const double x = w[j] / own[j];
        w[j] = x;
        for (int i = j + 1; i < tall; ++i) w[i] -= x * own[i];
    }
}

void substitute(const double* panel, int tall, int width, double* w) {
    for (int j = width - 1; j >= 0; --j) {
        const double* const own = panel + static_cast<long>(j) * tall;
        Lanes sums{};
        int i = j + 1;
        for (; i + 3 < tall; i += 4) sums += load(own + i) * load(w + i);
        double sum = sum_lanes(sums);
        for (; i < tall; ++i) sum += own[i] * w[i];
        w[j] = (w[j] - sum) / own[j];
    }
}

}  // namespace risorius::solve::detail
