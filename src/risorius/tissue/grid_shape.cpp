// SPDX-License-Identifier: MIT
#include "risorius/tissue/grid_shape.h"

#include <cassert>
#include <cmath>

namespace risorius::tissue {

namespace {

using Quad = std::array<int, 4>;

/// Quads of the six faces, counter-clockwise from outside when the axes are right-handed.
template <class Visit>
void for_each_surface_quad(const GridShape& grid, const Visit& visit) {
    for (int axis = grid.closed ? 1 : 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, w = (axis + 2) % 3;  // u, w, axis are right-handed
        for (const bool high : {false, true}) {
            int at[3];
            at[axis] = high ? grid.along(axis) - 1 : 0;
            for (int a = 0; a < grid.cells(u); ++a)
                for (int b = 0; b < grid.cells(w); ++b) {
                    const auto node = [&](int du, int dw) {
                        at[u] = (a + du) % grid.along(u);
                        at[w] = (b + dw) % grid.along(w);
                        return grid.index(at[0], at[1], at[2]);
                    };
                    const Quad quad = {node(0, 0), node(1, 0), node(1, 1), node(0, 1)};
                    visit(high ? quad : Quad{quad[0], quad[3], quad[2], quad[1]});
                }
        }
    }
}

}  // namespace

Points cylinder_rest(const GridShape& grid, double radius_m, double length_m, const Rigid& place) {
    Points rest(grid.size(), 3);
    for (int i = 0; i < grid.m; ++i)
        for (int j = 0; j < grid.n; ++j)
            for (int k = 0; k < grid.o; ++k) {
                const double y = 2 * j * grid.spacing(1) - 1;
                const double z = 2 * k * grid.spacing(2) - 1;
                const Vec3 p(length_m * i * grid.spacing(0),
                             radius_m * y * std::sqrt(1 - 0.5 * z * z),
                             radius_m * z * std::sqrt(1 - 0.5 * y * y));
                rest.row(grid.index(i, j, k)) = (place * p).transpose();
            }
    return rest;
}

std::vector<int> plane_nodes(const GridShape& grid, int axis, int index) {
    assert(axis >= 0 && axis < 3 && index >= 0 && index < grid.along(axis));
    std::vector<int> nodes;
    for (int i = 0; i < grid.m; ++i)
        for (int j = 0; j < grid.n; ++j)
            for (int k = 0; k < grid.o; ++k)
                if ((axis == 0 ? i : axis == 1 ? j : k) == index)
                    nodes.push_back(grid.index(i, j, k));
    return nodes;
}

Triangles surface_triangles(const GridShape& grid) {
    std::vector<Quad> quads;
    for_each_surface_quad(grid, [&](const Quad& quad) { quads.push_back(quad); });
    Triangles triangles(2 * static_cast<Eigen::Index>(quads.size()), 3);
    for (std::size_t q = 0; q < quads.size(); ++q) {
        const Quad& p = quads[q];
        triangles.row(2 * static_cast<Eigen::Index>(q)) << p[0], p[1], p[2];
        triangles.row(2 * static_cast<Eigen::Index>(q) + 1) << p[0], p[2], p[3];
    }
    return triangles;
}

std::vector<std::array<int, 2>> grid_lines(const GridShape& grid) {
    std::vector<std::array<int, 2>> lines;
    for (int i = 0; i < grid.m; ++i)
        for (int j = 0; j < grid.n; ++j)
            for (int k = 0; k < grid.o; ++k) {
                const int node = grid.index(i, j, k);
                if (i < grid.cells(0)) lines.push_back({node, grid.index(grid.next(i), j, k)});
                if (j + 1 < grid.n) lines.push_back({node, grid.index(i, j + 1, k)});
                if (k + 1 < grid.o) lines.push_back({node, grid.index(i, j, k + 1)});
            }
    return lines;
}

double enclosed_volume(const GridShape& grid, const Points& x) {
    assert(x.rows() == grid.size());
    // Relative to a point of the body, to avoid cancellation far from the origin.
    const Eigen::RowVector3d origin = x.row(0);
    double twelve_volumes = 0;
    for_each_surface_quad(grid, [&](const Quad& quad) {
        Vec3 p[4];
        for (std::size_t c = 0; c < 4; ++c) p[c] = (x.row(quad[c]) - origin).transpose();
        // A bilinear patch divides the tetrahedron of its corners in half. That tetrahedron lies between the two triangulations
        // of the quad.
        const auto six = [](const Vec3& a, const Vec3& b, const Vec3& c) {
            return a.dot(b.cross(c));
        };
        twelve_volumes += six(p[0], p[1], p[2]) + six(p[0], p[2], p[3]) + six(p[0], p[1], p[3]) +
                          six(p[1], p[2], p[3]);
    });
    return twelve_volumes / 12;
}

}  // namespace risorius::tissue
