// SPDX-License-Identifier: MIT
/// \file
/// Bodies and surfaces for tests of contact, made in code.
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::contact::testing {

struct Surface {
    Points positions;
    Triangles triangles;
};

/// Surface of a box with its lowest corner at `low`. Each face has cells x cells squares of two triangles.
inline Surface box(const Vec3& low, const Vec3& size, int cells) {
    Surface s;
    std::map<std::array<int, 3>, int> numbered;
    std::vector<Vec3> points;
    const auto vertex = [&](const std::array<int, 3>& at) {
        const auto [place, is_new] = numbered.try_emplace(at, static_cast<int>(points.size()));
        if (is_new) points.push_back(low + size.cwiseProduct(Vec3(at[0], at[1], at[2])) / cells);
        return place->second;
    };
    std::vector<Eigen::RowVector3i> triangles;
    for (int axis = 0; axis < 3; ++axis)
        for (const int end : {0, cells})
            for (int i = 0; i < cells; ++i)
                for (int j = 0; j < cells; ++j) {
                    const auto at = [&](int u, int v) {
                        std::array<int, 3> place;
                        place[axis] = end;
                        place[(axis + 1) % 3] = i + u;
                        place[(axis + 2) % 3] = j + v;
                        return vertex(place);
                    };
                    const int a = at(0, 0), b = at(1, 0), c = at(1, 1), d = at(0, 1);
                    if (end > 0) {
                        triangles.emplace_back(a, b, c), triangles.emplace_back(a, c, d);
                    } else {
                        triangles.emplace_back(a, c, b), triangles.emplace_back(a, d, c);
                    }
                }
    s.positions.resize(static_cast<long>(points.size()), 3);
    for (std::size_t i = 0; i < points.size(); ++i)
        s.positions.row(static_cast<long>(i)) = points[i].transpose();
    s.triangles.resize(static_cast<long>(triangles.size()), 3);
    for (std::size_t t = 0; t < triangles.size(); ++t)
        s.triangles.row(static_cast<long>(t)) = triangles[t];
    return s;
}

}  // namespace risorius::contact::testing
