// SPDX-License-Identifier: MIT
#include "risorius/tissue/detail/sheet_edges.h"

#include <algorithm>
#include <tuple>

namespace risorius::tissue::detail {

std::vector<std::array<EdgeSide, 2>> inner_edges(const Triangles& triangles) {
    std::vector<EdgeSide> sides;
    sides.reserve(static_cast<std::size_t>(3 * triangles.rows()));
    for (int t = 0; t < triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) {
            const int a = triangles(t, k), b = triangles(t, (k + 1) % 3);
            sides.push_back({std::min(a, b), std::max(a, b), t, k});
        }
    std::sort(sides.begin(), sides.end(), [](const EdgeSide& p, const EdgeSide& q) {
        return std::tie(p.low, p.high, p.triangle) < std::tie(q.low, q.high, q.triangle);
    });
    std::vector<std::array<EdgeSide, 2>> edges;
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t end = i + 1;
        while (end < sides.size() && sides[end].low == sides[i].low &&
               sides[end].high == sides[i].high)
            ++end;
        if (end - i == 2) edges.push_back({sides[i], sides[i + 1]});
        i = end;
    }
    return edges;
}

}  // namespace risorius::tissue::detail
