// SPDX-License-Identifier: MIT
/// \file
/// Sums over all nodes in a fixed order. So equal input gives equal results to the last bit.
#pragma once

#include <algorithm>
#include <cmath>

#include "risorius/core/types.h"
#include "risorius/solve/lanes.h"

namespace risorius::solve {

inline Lanes load_lanes(const double* p) { return Lanes{p[0], p[1], p[2], p[3]}; }
inline Lanes load_lanes(const float* p) {
    return __builtin_convertvector((FloatPoint{p[0], p[1], p[2], p[3]}), Lanes);
}

/// Points, or an array of rows like it in float. Sums are in double.
template <class T>
concept PointRows = requires(const T& rows) {
    load_lanes(rows.data());
};

/// Sum over all coordinates of a times b. Unlike in Eigen, the order of the sum does not depend on the memory address of the
/// arrays.
double dot(const PointRows auto& a, const PointRows auto& b) {
    const auto* p = a.data();
    const auto* q = b.data();
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
    for (; i < n; ++i) sum += static_cast<double>(p[i]) * static_cast<double>(q[i]);
    return sum;
}

/// Adds scale times a to `sum` and returns the dot product of the new sum with b, in one pass. b may be `sum`.
double add_and_dot(Points& sum, double scale, const PointRows auto& a, const PointRows auto& b) {
    double* s = sum.data();
    const auto* p = a.data();
    const auto* q = b.data();
    const long n = sum.size();
    Lanes even{}, odd{};
    long i = 0;
    for (; i + 7 < n; i += 8) {
        const Lanes first = load_lanes(s + i) + scale * load_lanes(p + i);
        const Lanes second = load_lanes(s + i + 4) + scale * load_lanes(p + i + 4);
        for (int k = 0; k < 4; ++k) {
            s[i + k] = first[k];
            s[i + 4 + k] = second[k];
        }
        even += first * load_lanes(q + i);
        odd += second * load_lanes(q + i + 4);
    }
    double product = sum_lanes(even + odd);
    for (; i < n; ++i) {
        s[i] += scale * p[i];
        product += s[i] * q[i];
    }
    return product;
}

/// Maximum of the lengths of the rows.
inline double longest_row(const Points& d) {
    double longest = 0;
    for (long i = 0; i < d.rows(); ++i) {
        const double* p = d.data() + 3 * i;
        longest = std::max(longest, p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    }
    return std::sqrt(longest);
}

}  // namespace risorius::solve
