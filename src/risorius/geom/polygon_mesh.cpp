// SPDX-License-Identifier: MIT
#include "risorius/geom/polygon_mesh.h"

#include <algorithm>
#include <array>

namespace risorius::geom {

Triangles triangulate(const PolygonMesh& mesh, const std::vector<int>& groups, Triangles* corners) {
    std::vector<std::array<int, 3>> out;
    for (int face = 0; face < mesh.face_count(); ++face) {
        if (!groups.empty() &&
            std::find(groups.begin(), groups.end(), mesh.face_group[face]) == groups.end())
            continue;
        const int first = mesh.face_begin[face], n = mesh.corner_count(face);
        int start = 0;
        if (n == 4) {
            const auto at = [&](int k) {
                return Vec3(mesh.positions.row(mesh.corner_vertex[first + k]).transpose());
            };
            if ((at(3) - at(1)).squaredNorm() < (at(2) - at(0)).squaredNorm()) start = 1;
        }
        for (int k = 1; k + 1 < n; ++k)
            out.push_back({first + start, first + (start + k) % n, first + (start + k + 1) % n});
    }
    Triangles triangles(static_cast<long>(out.size()), 3);
    if (corners) corners->resize(static_cast<long>(out.size()), 3);
    for (std::size_t t = 0; t < out.size(); ++t)
        for (int k = 0; k < 3; ++k) {
            triangles(static_cast<long>(t), k) = mesh.corner_vertex[out[t][k]];
            if (corners) (*corners)(static_cast<long>(t), k) = out[t][k];
        }
    return triangles;
}

}  // namespace risorius::geom
