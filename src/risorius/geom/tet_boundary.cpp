// SPDX-License-Identifier: MIT
#include "risorius/geom/tet_boundary.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace risorius::geom {

Triangles boundary_of(const Tets& tets) {
    static constexpr int kFaces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
    std::map<std::array<int, 3>, std::pair<int, std::array<int, 3>>> faces;
    for (Eigen::Index t = 0; t < tets.rows(); ++t)
        for (const auto& face : kFaces) {
            const std::array<int, 3> corners{tets(t, face[0]), tets(t, face[1]), tets(t, face[2])};
            std::array<int, 3> key = corners;
            std::sort(key.begin(), key.end());
            const auto [at, is_new] = faces.emplace(key, std::pair(1, corners));
            if (!is_new) ++at->second.first;
        }
    std::vector<std::array<int, 3>> outer;
    for (const auto& [key, face] : faces)
        if (face.first == 1) outer.push_back(face.second);
    Triangles out(static_cast<Eigen::Index>(outer.size()), 3);
    for (std::size_t f = 0; f < outer.size(); ++f)
        for (std::size_t k = 0; k < 3; ++k)
            out(static_cast<Eigen::Index>(f), static_cast<Eigen::Index>(k)) = outer[f][k];
    return out;
}

}  // namespace risorius::geom
