// Sums over all nodes in one fixed order, so that the same numbers give the same bits.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/types.h"
#include "solve/lanes.h"

namespace risorius::solve {

inline Lanes load_lanes(const double* p) { return Lanes{p[0], p[1], p[2], p[3]}; }

/// Its own loop rather than Eigen's, so that the order of the sum does not depend on where the
/// arrays lie in memory.
inline double dot(const Points& a, const Points& b) {
    const double* p = a.data();
    const double* q = b.data();
    const long n = a.size();
    Lanes s0{}, s1{}, s2{}, s3{};
    long i = 0;
    for (; i + 15 < n; i += 16) {
        s0 += load_lanes(p + i) * load_lanes(q + i);
        s1 += load_lanes(p + i + 4) * load_lanes(q + i + 4);
        s2 += load_lanes(p + i + 8) * load_lanes(q + i + 8);
        s3 += load_lanes(p + i + 12) * load_lanes(q + i + 12);
    }
    double sum = sum_lanes((s0 + s1) + (s2 + s3));
    for (; i < n; ++i) sum += p[i] * q[i];
    return sum;
}

inline double longest_row(const Points& d) {
    double longest = 0;
    for (long i = 0; i < d.rows(); ++i) {
        const double* p = d.data() + 3 * i;
        longest = std::max(longest, p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    }
    return std::sqrt(longest);
}

}  // namespace risorius::solve
