// SPDX-License-Identifier: MIT
/// \file
/// Vectors of four doubles or eight floats. GCC and Clang compile them to AVX2, SSE2, NEON or WASM instructions. Except for
/// fused(), the arithmetic and therefore the bits are the same in all of them.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::solve {

typedef double Lanes __attribute__((vector_size(32)));
typedef float FloatLanes __attribute__((vector_size(32)));
typedef float FloatPoint __attribute__((vector_size(16)));

/// Precision of the arithmetic in steps of motion. Float halves the memory traffic and doubles the lanes; equilibria and
/// derivatives need double.
enum class Precision { kDouble, kSingle };

template <class Real>
struct LanesOf;
template <>
struct LanesOf<double> {
    using Lane = Lanes;   ///< one number of each of kWidth elements
    using Point = Lanes;  ///< x y z 0
    static constexpr int kWidth = 4;
};
template <>
struct LanesOf<float> {
    using Lane = FloatLanes;
    using Point = FloatPoint;
    static constexpr int kWidth = 8;
};

/// Sum of the lanes, in a fixed order.
inline double sum_lanes(const Lanes& a) { return (a[0] + a[1]) + (a[2] + a[3]); }

/// Adds lanes to a sum that is kept in double.
inline void add_lanes(Lanes& sum, const Lanes& a) { sum += a; }
inline void add_lanes(Lanes& sum, const FloatLanes& a) {
    sum += __builtin_convertvector(__builtin_shufflevector(a, a, 0, 1, 2, 3), Lanes);
    sum += __builtin_convertvector(__builtin_shufflevector(a, a, 4, 5, 6, 7), Lanes);
}

inline Lanes sqrt_lanes(const Lanes& a) {
#ifdef __AVX__
    return Lanes(__builtin_ia32_sqrtpd256(a));
#else
    Lanes out;
    for (int k = 0; k < 4; ++k) out[k] = std::sqrt(a[k]);
    return out;
#endif
}
inline FloatLanes sqrt_lanes(const FloatLanes& a) {
#ifdef __AVX__
    return FloatLanes(__builtin_ia32_sqrtps256(a));
#else
    FloatLanes out;
    for (int k = 0; k < 8; ++k) out[k] = std::sqrt(a[k]);
    return out;
#endif
}

/// a b + c, rounded only once when the instruction set has such an instruction.
inline Lanes fused(const Lanes& a, const Lanes& b, const Lanes& c) {
#ifdef __FMA__
    return Lanes(__builtin_ia32_vfmaddpd256(a, b, c));
#else
    return a * b + c;
#endif
}
inline FloatLanes fused(const FloatLanes& a, const FloatLanes& b, const FloatLanes& c) {
#ifdef __FMA__
    return FloatLanes(__builtin_ia32_vfmaddps256(a, b, c));
#else
    return a * b + c;
#endif
}

/// Transposes four rows to columns.
inline void transpose(const Lanes (&r)[4], Lanes& c0, Lanes& c1, Lanes& c2, Lanes& c3) {
    const Lanes a = __builtin_shufflevector(r[0], r[1], 0, 4, 2, 6);
    const Lanes b = __builtin_shufflevector(r[0], r[1], 1, 5, 3, 7);
    const Lanes c = __builtin_shufflevector(r[2], r[3], 0, 4, 2, 6);
    const Lanes d = __builtin_shufflevector(r[2], r[3], 1, 5, 3, 7);
    c0 = __builtin_shufflevector(a, c, 0, 1, 4, 5);
    c1 = __builtin_shufflevector(b, d, 0, 1, 4, 5);
    c2 = __builtin_shufflevector(a, c, 2, 3, 6, 7);
    c3 = __builtin_shufflevector(b, d, 2, 3, 6, 7);
}

/// Converts rows (x y z -) of four points to lanes of x, y and z.
inline void rows_to_lanes(const Lanes& r0, const Lanes& r1, const Lanes& r2, const Lanes& r3,
                          Lanes& x, Lanes& y, Lanes& z) {
    const Lanes rows[4] = {r0, r1, r2, r3};
    Lanes rest;
    transpose(rows, x, y, z, rest);
}

/// The inverse of rows_to_lanes. The fourth column is zero.
inline void lanes_to_rows(const Lanes& x, const Lanes& y, const Lanes& z, Lanes& r0, Lanes& r1,
                          Lanes& r2, Lanes& r3) {
    const Lanes zero{};
    const Lanes a = __builtin_shufflevector(x, y, 0, 4, 2, 6);
    const Lanes b = __builtin_shufflevector(x, y, 1, 5, 3, 7);
    const Lanes c = __builtin_shufflevector(z, zero, 0, 4, 2, 6);
    const Lanes d = __builtin_shufflevector(z, zero, 1, 5, 3, 7);
    r0 = __builtin_shufflevector(a, c, 0, 1, 4, 5);
    r1 = __builtin_shufflevector(b, d, 0, 1, 4, 5);
    r2 = __builtin_shufflevector(a, c, 2, 3, 6, 7);
    r3 = __builtin_shufflevector(b, d, 2, 3, 6, 7);
}

/// The same for an array of as many rows as there are lanes.
inline void rows_to_lanes(const Lanes (&r)[4], Lanes& x, Lanes& y, Lanes& z) {
    rows_to_lanes(r[0], r[1], r[2], r[3], x, y, z);
}
inline void lanes_to_rows(const Lanes& x, const Lanes& y, const Lanes& z, Lanes (&r)[4]) {
    lanes_to_rows(x, y, z, r[0], r[1], r[2], r[3]);
}
inline void rows_to_lanes(const FloatPoint (&r)[8], FloatLanes& x, FloatLanes& y, FloatLanes& z) {
    FloatLanes a[4];
    for (int i = 0; i < 4; ++i)
        a[i] = __builtin_shufflevector(r[i], r[i + 4], 0, 1, 2, 3, 4, 5, 6, 7);
    const FloatLanes xy01 = __builtin_shufflevector(a[0], a[1], 0, 8, 1, 9, 4, 12, 5, 13);
    const FloatLanes xy23 = __builtin_shufflevector(a[2], a[3], 0, 8, 1, 9, 4, 12, 5, 13);
    const FloatLanes z01 = __builtin_shufflevector(a[0], a[1], 2, 10, 3, 11, 6, 14, 7, 15);
    const FloatLanes z23 = __builtin_shufflevector(a[2], a[3], 2, 10, 3, 11, 6, 14, 7, 15);
    x = __builtin_shufflevector(xy01, xy23, 0, 1, 8, 9, 4, 5, 12, 13);
    y = __builtin_shufflevector(xy01, xy23, 2, 3, 10, 11, 6, 7, 14, 15);
    z = __builtin_shufflevector(z01, z23, 0, 1, 8, 9, 4, 5, 12, 13);
}
inline void lanes_to_rows(const FloatLanes& x, const FloatLanes& y, const FloatLanes& z,
                          FloatPoint (&r)[8]) {
    const FloatLanes zero{};
    const FloatLanes xy01 = __builtin_shufflevector(x, y, 0, 8, 1, 9, 4, 12, 5, 13);
    const FloatLanes xy23 = __builtin_shufflevector(x, y, 2, 10, 3, 11, 6, 14, 7, 15);
    const FloatLanes z01 = __builtin_shufflevector(z, zero, 0, 8, 1, 9, 4, 12, 5, 13);
    const FloatLanes z23 = __builtin_shufflevector(z, zero, 2, 10, 3, 11, 6, 14, 7, 15);
    const FloatLanes a[4] = {__builtin_shufflevector(xy01, z01, 0, 1, 8, 9, 4, 5, 12, 13),
                             __builtin_shufflevector(xy01, z01, 2, 3, 10, 11, 6, 7, 14, 15),
                             __builtin_shufflevector(xy23, z23, 0, 1, 8, 9, 4, 5, 12, 13),
                             __builtin_shufflevector(xy23, z23, 2, 3, 10, 11, 6, 7, 14, 15)};
    for (int i = 0; i < 4; ++i) {
        r[i] = __builtin_shufflevector(a[i], a[i], 0, 1, 2, 3);
        r[i + 4] = __builtin_shufflevector(a[i], a[i], 4, 5, 6, 7);
    }
}

/// Rows of four numbers (x y z 0), one for each point, so that a point is loaded by one aligned instruction. Memory is kept
/// between calls.
template <class Real>
class PaddedRows {
  public:
    using Point = typename LanesOf<Real>::Point;
    Point& operator[](int i) { return rows_[static_cast<std::size_t>(i)].lanes; }
    const Point& operator[](int i) const { return rows_[static_cast<std::size_t>(i)].lanes; }

    void copy(const Points& x) {
        rows_.resize(static_cast<std::size_t>(x.rows()));
        const double* from = x.data();
        for (Row& row : rows_) {
            row.lanes = Point{static_cast<Real>(from[0]), static_cast<Real>(from[1]),
                              static_cast<Real>(from[2]), Real(0)};
            from += 3;
        }
    }
    /// Sets the rows to x - y, rounded after the subtraction.
    void copy_difference(const Points& x, const Points& y) {
        rows_.resize(static_cast<std::size_t>(y.rows()));
        const double* from = x.data();
        const double* less = y.data();
        for (Row& row : rows_) {
            row.lanes =
                Point{static_cast<Real>(from[0] - less[0]), static_cast<Real>(from[1] - less[1]),
                      static_cast<Real>(from[2] - less[2]), Real(0)};
            from += 3;
            less += 3;
        }
    }
    /// Sets row i to x(rows[i]) - y(i), for all rows of y.
    void copy_difference(const Points& x, std::span<const int> rows, const Points& y) {
        rows_.resize(static_cast<std::size_t>(y.rows()));
        const double* less = y.data();
        for (std::size_t i = 0; i < rows_.size(); ++i, less += 3) {
            const double* from = x.data() + 3 * static_cast<std::ptrdiff_t>(rows[i]);
            rows_[i].lanes =
                Point{static_cast<Real>(from[0] - less[0]), static_cast<Real>(from[1] - less[1]),
                      static_cast<Real>(from[2] - less[2]), Real(0)};
        }
    }
    void set_zero(long rows) { rows_.assign(static_cast<std::size_t>(rows), Row{}); }
    void add_to(Points& x) const {
        double* to = x.data();
        for (const Row& row : rows_) {
            to[0] += row.lanes[0];
            to[1] += row.lanes[1];
            to[2] += row.lanes[2];
            to += 3;
        }
    }
    /// Adds row i to x(rows[i]).
    void add_to(Points& x, std::span<const int> rows) const {
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            double* to = x.data() + 3 * static_cast<std::ptrdiff_t>(rows[i]);
            for (int c = 0; c < 3; ++c) to[c] += rows_[i].lanes[c];
        }
    }

  private:
    struct Row {
        Point lanes{};
    };
    std::vector<Row> rows_;
};
using PaddedPoints = PaddedRows<double>;

}  // namespace risorius::solve
