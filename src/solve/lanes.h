// Four doubles worked on together. GCC and Clang turn these into AVX2, SSE2, NEON or WASM
// instructions; the arithmetic is the same in all of them, so the bits are too.
#pragma once

#include <vector>

#include "core/types.h"

namespace risorius::solve {

typedef double Lanes __attribute__((vector_size(32)));

inline Lanes all_lanes(double value) { return Lanes{value, value, value, value}; }

/// Sum of the lanes, always in this order.
inline double sum_lanes(const Lanes& a) { return (a[0] + a[1]) + (a[2] + a[3]); }

/// Rows (x y z -) of four points to their x, y and z lanes.
inline void rows_to_lanes(const Lanes& r0, const Lanes& r1, const Lanes& r2, const Lanes& r3,
                          Lanes& x, Lanes& y, Lanes& z) {
    const Lanes a = __builtin_shufflevector(r0, r1, 0, 4, 2, 6);
    const Lanes b = __builtin_shufflevector(r0, r1, 1, 5, 3, 7);
    const Lanes c = __builtin_shufflevector(r2, r3, 0, 4, 2, 6);
    const Lanes d = __builtin_shufflevector(r2, r3, 1, 5, 3, 7);
    x = __builtin_shufflevector(a, c, 0, 1, 4, 5);
    y = __builtin_shufflevector(b, d, 0, 1, 4, 5);
    z = __builtin_shufflevector(a, c, 2, 3, 6, 7);
}

/// The other way round; the fourth column is zero.
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

/// One point per 32 bytes (x y z 0), so that a point is one aligned load. Kept between calls to
/// save the allocation.
class PaddedPoints {
  public:
    Lanes& operator[](int i) { return rows_[static_cast<std::size_t>(i)].lanes; }
    const Lanes& operator[](int i) const { return rows_[static_cast<std::size_t>(i)].lanes; }

    void copy(const Points& x) {
        rows_.resize(static_cast<std::size_t>(x.rows()));
        const double* from = x.data();
        for (Row& row : rows_) {
            row.lanes = Lanes{from[0], from[1], from[2], 0.0};
            from += 3;
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

  private:
    struct Row {
        Lanes lanes{};
    };
    std::vector<Row> rows_;
};

}  // namespace risorius::solve
