// SPDX-License-Identifier: MIT
/// \file
/// Small surfaces for tests, made in code.
#pragma once

#include <cmath>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::geom::testing {

struct Surface {
    Points positions;
    Triangles triangles;
};

/// n x n cells of two triangles in the plane z = 0, unit square, facing +z.
inline Surface square_grid(int n) {
    Surface s;
    s.positions.resize((n + 1) * (n + 1), 3);
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i)
            s.positions.row(j * (n + 1) + i) << i / static_cast<double>(n),
                j / static_cast<double>(n), 0.0;
    s.triangles.resize(2 * n * n, 3);
    int t = 0;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const int a = j * (n + 1) + i, b = a + 1, c = a + n + 2, d = a + n + 1;
            s.triangles.row(t++) << a, b, c;
            s.triangles.row(t++) << a, c, d;
        }
    return s;
}

/// A closed sphere of `rings` x `sectors`, facing outwards.
inline Surface sphere(int rings, int sectors, double radius) {
    Surface s;
    s.positions.resize(2 + (rings - 1) * sectors, 3);
    s.positions.row(0) << 0, 0, radius;
    for (int r = 1; r < rings; ++r)
        for (int k = 0; k < sectors; ++k) {
            const double polar = M_PI * r / rings, turn = 2 * M_PI * k / sectors;
            s.positions.row(1 + (r - 1) * sectors + k) << radius * std::sin(polar) * std::cos(turn),
                radius * std::sin(polar) * std::sin(turn), radius * std::cos(polar);
        }
    const int last = static_cast<int>(s.positions.rows()) - 1;
    s.positions.row(last) << 0, 0, -radius;
    const auto at = [&](int r, int k) { return 1 + (r - 1) * sectors + k % sectors; };
    std::vector<Eigen::RowVector3i> triangles;
    for (int k = 0; k < sectors; ++k) triangles.emplace_back(0, at(1, k), at(1, k + 1));
    for (int r = 1; r + 1 < rings; ++r)
        for (int k = 0; k < sectors; ++k) {
            triangles.emplace_back(at(r, k), at(r + 1, k), at(r + 1, k + 1));
            triangles.emplace_back(at(r, k), at(r + 1, k + 1), at(r, k + 1));
        }
    for (int k = 0; k < sectors; ++k)
        triangles.emplace_back(at(rings - 1, k), last, at(rings - 1, k + 1));
    s.triangles.resize(static_cast<long>(triangles.size()), 3);
    for (std::size_t t = 0; t < triangles.size(); ++t)
        s.triangles.row(static_cast<long>(t)) = triangles[t];
    return s;
}

}  // namespace risorius::geom::testing
