// SPDX-License-Identifier: MIT
/// \file
/// Blocks of cubes of six tetrahedra each.
#pragma once

#include <array>
#include <utility>

#include "risorius/core/types.h"

namespace risorius::testing_of {

struct TetBlock {
    Points rest;
    Tets tets;
    std::array<int, 3> cells{};
};

/// `edges_m` from the origin on.
inline TetBlock tet_block(const std::array<int, 3>& cells, const Vec3& edges_m) {
    TetBlock out;
    out.cells = cells;
    const auto node = [&](const std::array<int, 3>& at) {
        return (at[0] * (cells[1] + 1) + at[1]) * (cells[2] + 1) + at[2];
    };
    out.rest.resize((cells[0] + 1) * (cells[1] + 1) * (cells[2] + 1), 3);
    out.tets.resize(6 * cells[0] * cells[1] * cells[2], 4);
    constexpr std::array<std::array<int, 3>, 6> kPaths{
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
    std::array<int, 3> at{};
    int row = 0;
    for (at[0] = 0; at[0] <= cells[0]; ++at[0])
        for (at[1] = 0; at[1] <= cells[1]; ++at[1])
            for (at[2] = 0; at[2] <= cells[2]; ++at[2]) {
                bool inner = true;
                for (std::size_t k = 0; k < 3; ++k) {
                    out.rest(node(at), static_cast<int>(k)) =
                        edges_m[static_cast<int>(k)] * at[k] / cells[k];
                    inner = inner && at[k] < cells[k];
                }
                for (std::size_t p = 0; p < 6 && inner; ++p, ++row) {
                    std::array<int, 3> corner = at;
                    out.tets(row, 0) = node(corner);
                    for (std::size_t step = 0; step < 3; ++step) {
                        ++corner[static_cast<std::size_t>(kPaths[p][step])];
                        out.tets(row, static_cast<int>(step) + 1) = node(corner);
                    }
                    if (p >= 3) std::swap(out.tets(row, 2), out.tets(row, 3));
                }
            }
    return out;
}

/// One flag per node whose coordinate `axis` is `at`.
inline std::vector<char> face_of(const Points& rest, int axis, double at) {
    std::vector<char> out;
    for (Eigen::Index i = 0; i < rest.rows(); ++i)
        out.push_back(std::abs(rest(i, axis) - at) < 1e-9 ? 1 : 0);
    return out;
}

}  // namespace risorius::testing_of
