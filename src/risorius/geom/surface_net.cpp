// SPDX-License-Identifier: MIT
#include "risorius/geom/surface_net.h"

#include <algorithm>
#include <cmath>

namespace risorius::geom {

GridField::GridField(const Vec3& low, const Vec3& high, double step, float value)
    : origin(low), step_m(step) {
    std::size_t count = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        size[a] = std::max(2, static_cast<int>(std::ceil((high - low)[axis] / step)) + 1);
        count *= static_cast<std::size_t>(size[a]);
    }
    values.assign(count, value);
}

double GridField::at(const Vec3& p) const {
    std::array<int, 3> cell{};
    Vec3 fraction;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const double x =
            std::clamp((p[axis] - origin[axis]) / step_m, 0.0, static_cast<double>(size[a] - 1));
        cell[a] = std::min(static_cast<int>(x), size[a] - 2);
        fraction[axis] = x - cell[a];
    }
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const int dx = corner & 1, dy = corner >> 1 & 1, dz = corner >> 2;
        const double weight = (dx ? fraction.x() : 1 - fraction.x()) *
                              (dy ? fraction.y() : 1 - fraction.y()) *
                              (dz ? fraction.z() : 1 - fraction.z());
        sum += weight * values[index(cell[0] + dx, cell[1] + dy, cell[2] + dz)];
    }
    return sum;
}

NetSurface surface_net(const GridField& field) {
    const auto& size = field.size;
    std::vector<int> vertex_of(field.values.size(), -1);  // by the first sample of the cell
    std::vector<Vec3> vertices;
    const auto inside = [&](int i, int j, int k) { return field.values[field.index(i, j, k)] < 0; };

    // One vertex in every cell that the surface crosses.
    for (int k = 0; k + 1 < size[2]; ++k)
        for (int j = 0; j + 1 < size[1]; ++j)
            for (int i = 0; i + 1 < size[0]; ++i) {
                std::array<float, 8> f{};
                for (int c = 0; c < 8; ++c)
                    f[static_cast<std::size_t>(c)] =
                        field.values[field.index(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2))];
                Vec3 sum = Vec3::Zero();
                int crossings = 0;
                for (int c = 0; c < 8; ++c)
                    for (int axis = 0; axis < 3; ++axis) {
                        const int d = c | 1 << axis;
                        if (d == c) continue;
                        const double a = f[static_cast<std::size_t>(c)],
                                     b = f[static_cast<std::size_t>(d)];
                        if ((a < 0) == (b < 0)) continue;
                        Vec3 at(c & 1, c >> 1 & 1, c >> 2);
                        at[axis] += a / (a - b);
                        sum += at;
                        ++crossings;
                    }
                if (crossings == 0) continue;
                vertex_of[field.index(i, j, k)] = static_cast<int>(vertices.size());
                vertices.push_back(field.place(i, j, k) + field.step_m * sum / crossings);
            }

    // One quad of four cells around every edge that the surface crosses.
    std::vector<std::array<int, 3>> faces;
    for (int k = 1; k + 1 < size[2]; ++k)
        for (int j = 1; j + 1 < size[1]; ++j)
            for (int i = 1; i + 1 < size[0]; ++i)
                for (int axis = 0; axis < 3; ++axis) {
                    const std::array<int, 3> step{axis == 0, axis == 1, axis == 2};
                    const bool here = inside(i, j, k);
                    if (here == inside(i + step[0], j + step[1], k + step[2])) continue;
                    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
                    std::array<int, 4> around{};
                    for (int c = 0; c < 4; ++c) {
                        std::array<int, 3> cell{i, j, k};
                        if (c == 1 || c == 2) --cell[static_cast<std::size_t>(u)];
                        if (c >= 2) --cell[static_cast<std::size_t>(v)];
                        around[static_cast<std::size_t>(c)] =
                            vertex_of[field.index(cell[0], cell[1], cell[2])];
                    }
                    if (!here) std::swap(around[1], around[3]);
                    faces.push_back({around[0], around[1], around[2]});
                    faces.push_back({around[0], around[2], around[3]});
                }

    NetSurface surface;
    surface.vertices.resize(static_cast<long>(vertices.size()), 3);
    for (std::size_t v = 0; v < vertices.size(); ++v)
        surface.vertices.row(static_cast<long>(v)) = vertices[v].transpose();
    surface.triangles.resize(static_cast<long>(faces.size()), 3);
    for (std::size_t t = 0; t < faces.size(); ++t)
        for (int c = 0; c < 3; ++c)
            surface.triangles(static_cast<long>(t), c) = faces[t][static_cast<std::size_t>(c)];
    return surface;
}

}  // namespace risorius::geom
