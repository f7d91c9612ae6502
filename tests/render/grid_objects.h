// SPDX-License-Identifier: MIT
/// \file
/// Objects of the kind experiments draw, made up without physics: a hanging block, a cloth, a tube.
#pragma once

#include <cmath>
#include <numbers>

#include "risorius/render/object_view.h"

namespace risorius::render {

/// n^3 nodes of a cube of 3 m, sagging and narrowed as if it hung from its top layer.
inline Object hanging_block(int n) {
    Object block;
    const auto index = [n](int i, int j, int k) { return (k * n + j) * n + i; };
    block.positions.resize(n * n * n, 3);
    for (int k = 0; k < n; ++k)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const double x = 3.0 * i / (n - 1) - 1.5, y = 3.0 * j / (n - 1) - 1.5;
                const double z = 3.0 * k / (n - 1) - 3, down = -z / 3;
                const double narrow = 1 - 0.28 * std::sin(down * 2.6);
                block.positions.row(index(i, j, k)) << x * narrow, y * narrow,
                    z * (1 + 0.25 * (1 - down / 2)) - 0.08 * down * (x * x + y * y - 2);
                if (i + 1 < n) block.wires.push_back({index(i, j, k), index(i + 1, j, k)});
                if (j + 1 < n) block.wires.push_back({index(i, j, k), index(i, j + 1, k)});
                if (k + 1 < n) block.wires.push_back({index(i, j, k), index(i, j, k + 1)});
                if (k + 1 == n) block.fixed.push_back(index(i, j, k));
            }
    std::vector<std::array<int, 3>> faces;
    const auto quad = [&](int a, int b, int c, int d) {
        faces.push_back({a, b, c});
        faces.push_back({a, c, d});
    };
    const int m = n - 1;
    for (int v = 0; v < m; ++v)
        for (int u = 0; u < m; ++u) {
            quad(index(u, v, 0), index(u, v + 1, 0), index(u + 1, v + 1, 0), index(u + 1, v, 0));
            quad(index(u, v, m), index(u + 1, v, m), index(u + 1, v + 1, m), index(u, v + 1, m));
            quad(index(u, 0, v), index(u + 1, 0, v), index(u + 1, 0, v + 1), index(u, 0, v + 1));
            quad(index(u, m, v), index(u, m, v + 1), index(u + 1, m, v + 1), index(u + 1, m, v));
            quad(index(0, u, v), index(0, u, v + 1), index(0, u + 1, v + 1), index(0, u + 1, v));
            quad(index(m, u, v), index(m, u + 1, v), index(m, u + 1, v + 1), index(m, u, v + 1));
        }
    block.surface.resize(static_cast<Eigen::Index>(faces.size()), 3);
    for (std::size_t f = 0; f < faces.size(); ++f)
        block.surface.row(static_cast<Eigen::Index>(f)) << faces[f][0], faces[f][1], faces[f][2];
    return block;
}

/// rows x columns nodes; each row closes to a ring when `closed`.
inline Object sheet(int rows, int columns, bool closed, Vec3 (*place)(double u, double v)) {
    Object object;
    object.positions.resize(rows * columns, 3);
    const auto index = [columns](int r, int c) { return r * columns + c % columns; };
    std::vector<std::array<int, 3>> faces;
    const int across = closed ? columns : columns - 1;
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c) {
            object.positions.row(index(r, c)) =
                place(static_cast<double>(r) / (rows - 1), static_cast<double>(c) / across)
                    .transpose();
            if (c < across) object.wires.push_back({index(r, c), index(r, c + 1)});
            if (r + 1 < rows) object.wires.push_back({index(r, c), index(r + 1, c)});
            if (r + 1 < rows && c < across) {
                faces.push_back({index(r, c), index(r, c + 1), index(r + 1, c + 1)});
                faces.push_back({index(r, c), index(r + 1, c + 1), index(r + 1, c)});
            }
            if (r == 0) object.fixed.push_back(index(r, c));
        }
    object.surface.resize(static_cast<Eigen::Index>(faces.size()), 3);
    for (std::size_t f = 0; f < faces.size(); ++f)
        object.surface.row(static_cast<Eigen::Index>(f)) << faces[f][0], faces[f][1], faces[f][2];
    return object;
}

inline Object cloth() {
    return sheet(13, 13, false, [](double u, double v) {
        const double sag = 1.1 * std::sin(u * 2.4) * (0.6 + 0.4 * std::cos(3 * v));
        return Vec3(3 * v - 1.5, 3 * u * 0.85 - 1.5, -sag + 0.12 * std::sin(9 * v) * u);
    });
}

inline Object tube() {
    return sheet(13, 14, true, [](double u, double v) {
        const double turn = 2 * std::numbers::pi * v, radius = 0.6 * (1 - 0.25 * u * u);
        return Vec3(3 * u - 1.5, radius * std::cos(turn), radius * std::sin(turn) - 0.7 * u * u);
    });
}

}  // namespace risorius::render
