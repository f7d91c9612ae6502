// SPDX-License-Identifier: MIT
#include "risorius/tissue/surface_material.h"

#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "risorius/core/error.h"
#include "risorius/tissue/detail/material_checks.h"

namespace risorius::tissue {

namespace {

/// The four nodes of a cell, counter-clockwise in a.
std::array<int, 4> cell_nodes(const SurfaceGrid& grid, int i, int j) {
    const int next = (j + 1) % grid.n;
    return {grid.index(i, j), grid.index(i + 1, j), grid.index(i + 1, next), grid.index(i, next)};
}

template <class Visit>
void for_each_cell(const SurfaceGrid& grid, const Visit& visit) {
    for (int i = 0; i < grid.links(0); ++i)
        for (int j = 0; j < grid.links(1); ++j) visit(i, j);
}

void check_not_folded(const GridSurface& surface, const std::string& place) {
    const SurfaceGrid& grid = surface.grid;
    const double size =
        (surface.rest.colwise().maxCoeff() - surface.rest.colwise().minCoeff()).maxCoeff();
    const double min_area = 1e-12 * size * size / grid.size();
    std::vector<Vec3> normals;
    const auto named = [](int i, int j) {
        return "cell [" + std::to_string(i) + ", " + std::to_string(j) + "]";
    };
    for_each_cell(grid, [&](int i, int j) {
        const auto nodes = cell_nodes(grid, i, j);
        const auto corner = [&](int k) -> Vec3 {
            return surface.rest.row(nodes[static_cast<std::size_t>(k % 4)]).transpose();
        };
        const Vec3 normal = (corner(2) - corner(0)).cross(corner(3) - corner(1));
        for (int k = 0; k < 4; ++k) {
            const Vec3 area = (corner(k + 1) - corner(k)).cross(corner(k + 3) - corner(k));
            if (!(area.norm() > min_area))
                throw Error(place, "a shape with an area in each corner of every cell",
                            "none in " + named(i, j));
            if (!(area.dot(normal) > 0))
                throw Error(place, "a shape without folds", "a folded " + named(i, j));
        }
        normals.push_back(normal.normalized());
    });
    // Cosine at which a cell counts as lying flat on its neighbour. A tube of three nodes turns by 120 degrees, which is
    // allowed.
    constexpr double kFlatFold = -0.99;
    const int columns = grid.links(1);
    const auto normal_at = [&](int i, int j) {
        return normals[static_cast<std::size_t>(i * columns + j % columns)];
    };
    for_each_cell(grid, [&](int i, int j) {
        const bool folds_along_m =
            i + 1 < grid.links(0) && normal_at(i, j).dot(normal_at(i + 1, j)) < kFlatFold;
        const bool folds_along_n = (grid.closed || j + 1 < columns) &&
                                   normal_at(i, j).dot(normal_at(i, j + 1)) < kFlatFold;
        if (folds_along_m || folds_along_n)
            throw Error(place, "a shape without folds",
                        named(i, j) + " lying on the next along " + (folds_along_m ? "m" : "n"));
    });
}

}  // namespace

SurfaceMaterial isotropic_surface(double elastic_n_per_m3, double damping_ns_per_m3,
                                  double bending_n_per_m, double mass_kg, double drag_ns_per_m) {
    SurfaceMaterial material;
    material.elastic_n_per_m3.setConstant(elastic_n_per_m3);
    material.damping_ns_per_m3.setConstant(damping_ns_per_m3);
    material.bending_n_per_m.setConstant(bending_n_per_m);
    material.mass_kg = mass_kg;
    material.drag_ns_per_m = drag_ns_per_m;
    return material;
}

Points sheet_rest(const SurfaceGrid& grid, const Vec2& size_m, const Rigid& place) {
    assert(!grid.closed);
    Points rest(grid.size(), 3);
    for (int i = 0; i < grid.m; ++i)
        for (int j = 0; j < grid.n; ++j)
            rest.row(grid.index(i, j)) =
                (place * Vec3(size_m[0] * i * grid.spacing(0), size_m[1] * j * grid.spacing(1), 0))
                    .transpose();
    return rest;
}

Points tube_rest(const SurfaceGrid& grid, double radius_m, double length_m, const Rigid& place) {
    assert(grid.closed);
    Points rest(grid.size(), 3);
    for (int i = 0; i < grid.m; ++i)
        for (int j = 0; j < grid.n; ++j) {
            const double angle = 2 * std::numbers::pi * j * grid.spacing(1);
            rest.row(grid.index(i, j)) =
                (place * Vec3(length_m * i * grid.spacing(0), radius_m * std::cos(angle),
                              radius_m * std::sin(angle)))
                    .transpose();
        }
    return rest;
}

Triangles surface_triangles(const SurfaceGrid& grid) {
    Triangles triangles(2 * grid.links(0) * grid.links(1), 3);
    Eigen::Index t = 0;
    for_each_cell(grid, [&](int i, int j) {
        // a1 x a2 points out of the upper side of a sheet, but into a tube.
        const auto [a, b, c, d] = cell_nodes(grid, i, j);
        if (grid.closed) {
            triangles.row(t++) << a, c, b;
            triangles.row(t++) << a, d, c;
        } else {
            triangles.row(t++) << a, b, c;
            triangles.row(t++) << a, c, d;
        }
    });
    return triangles;
}

std::vector<std::array<int, 2>> grid_lines(const SurfaceGrid& grid) {
    std::vector<std::array<int, 2>> lines;
    for (int i = 0; i < grid.m; ++i)
        for (int j = 0; j < grid.n; ++j) {
            if (i + 1 < grid.m) lines.push_back({grid.index(i, j), grid.index(i + 1, j)});
            if (j < grid.links(1))
                lines.push_back({grid.index(i, j), grid.index(i, (j + 1) % grid.n)});
        }
    return lines;
}

void check(const SurfaceMaterial& material, const std::string& place) {
    check_tensor(material.elastic_n_per_m3, place + "/elastic_n_per_m3");
    check_tensor(material.damping_ns_per_m3, place + "/damping_ns_per_m3");
    check_tensor(material.bending_n_per_m, place + "/bending_n_per_m");
    check_range(material.mass_kg, /*zero_allowed=*/false, place + "/mass_kg");
    check_range(material.drag_ns_per_m, /*zero_allowed=*/true, place + "/drag_ns_per_m");
}

void check(const GridSurface& surface, const std::string& place) {
    const SurfaceGrid& grid = surface.grid;
    if (grid.m < 2) throw Error(place + "/grid/m", "at least 2 nodes", std::to_string(grid.m));
    if (grid.closed && grid.n < 3)
        throw Error(place + "/grid/n", "at least 3 nodes around", std::to_string(grid.n));
    if (grid.n < 2) throw Error(place + "/grid/n", "at least 2 nodes", std::to_string(grid.n));
    const std::string sizes = std::to_string(grid.m) + " x " + std::to_string(grid.n) + " = " +
                              std::to_string(grid.size());

    if (surface.rest.rows() != grid.size())
        throw Error(place + "/rest", sizes + " points", std::to_string(surface.rest.rows()));
    for (int node = 0; node < grid.size(); ++node)
        if (!surface.rest.row(node).allFinite())
            throw Error(place + "/rest/" + std::to_string(node), "three finite numbers",
                        shown(Vec3(surface.rest.row(node))));
    check_not_folded(surface, place + "/rest");

    if (surface.material.size() == 1) {
        check(surface.material.front(), place + "/material");
        return;
    }
    if (static_cast<int>(surface.material.size()) != grid.size())
        throw Error(place + "/material", "1 material or " + sizes + ", one per node",
                    std::to_string(surface.material.size()));
    for (std::size_t node = 0; node < surface.material.size(); ++node)
        check(surface.material[node], place + "/material/" + std::to_string(node));
}

const SurfaceMaterial& material_of(const GridSurface& surface, int node) {
    assert(!surface.material.empty());
    return surface.material.size() == 1 ? surface.material.front()
                                        : surface.material[static_cast<std::size_t>(node)];
}

Eigen::VectorXd node_mass(const GridSurface& surface) {
    const int nodes = surface.grid.size();
    Eigen::VectorXd mass(nodes);
    for (int node = 0; node < nodes; ++node)
        mass[node] = material_of(surface, node).mass_kg / nodes;
    return mass;
}

Eigen::VectorXd node_drag(const GridSurface& surface) {
    Eigen::VectorXd drag(surface.grid.size());
    for (int node = 0; node < surface.grid.size(); ++node)
        drag[node] = material_of(surface, node).drag_ns_per_m;
    return drag;
}

Mat2 metric_weights(const SurfaceGrid& grid, Parameters parameters) {
    if (parameters == Parameters::kPerNode) return Mat2::Ones();
    const double w1 = 1.0 / (grid.links(0) * grid.n), w2 = 1.0 / (grid.m * grid.links(1));
    Mat2 w;
    w << w1, 0.5 * (w1 + w2), 0.5 * (w1 + w2), w2;
    return w;
}

Mat2 bending_weights(const SurfaceGrid& grid, Parameters parameters) {
    if (parameters == Parameters::kPerNode) return Mat2::Ones();
    const double cells = grid.links(0) * grid.links(1);
    Mat2 w;
    w << 1.0 / (grid.links(0) * grid.n), 1 / cells, 1 / cells, 1.0 / (grid.m * grid.links(1));
    return w;
}

SheetConstants sheet_of(double shear_pa, double thickness_m) {
    const double k = shear_pa * thickness_m;
    SheetConstants sheet;
    sheet.membrane_n_per_m.setConstant(k);
    sheet.bending_n_m.setConstant(k * thickness_m * thickness_m / 6);
    return sheet;
}

namespace {
/// L1 L2 / (Li^2 Lj^2)
Mat2 per_length(const Vec2& size_m) {
    const Vec2 inverse_square = size_m.cwiseAbs2().cwiseInverse();
    return size_m.prod() * inverse_square * inverse_square.transpose();
}
}  // namespace

SurfaceMaterial surface_material(const SheetConstants& sheet, const Vec2& size_m) {
    SurfaceMaterial material;
    material.elastic_n_per_m3 = sheet.membrane_n_per_m.cwiseProduct(per_length(size_m));
    material.bending_n_per_m = sheet.bending_n_m.cwiseProduct(per_length(size_m));
    return material;
}

SheetConstants sheet_constants(const SurfaceMaterial& material, const Vec2& size_m) {
    SheetConstants sheet;
    sheet.membrane_n_per_m = material.elastic_n_per_m3.cwiseQuotient(per_length(size_m));
    sheet.bending_n_m = material.bending_n_per_m.cwiseQuotient(per_length(size_m));
    return sheet;
}

double hinge_bending(double bending_n_m) { return bending_n_m / 3; }

}  // namespace risorius::tissue
