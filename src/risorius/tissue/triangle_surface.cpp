// SPDX-License-Identifier: MIT
#include "risorius/tissue/triangle_surface.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <random>

#include "risorius/core/error.h"
#include "risorius/tissue/detail/sheet_edges.h"

namespace risorius::tissue {

namespace {

using Flat = Eigen::Matrix<double, 2, 3>;

using detail::point;

/// a of each node, MN x 2.
using Coordinates = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

Coordinates grid_coordinates(const SurfaceGrid& grid) {
    Coordinates a(grid.size(), 2);
    for (int i = 0; i < grid.m; ++i)
        for (int j = 0; j < grid.n; ++j)
            a.row(grid.index(i, j)) << i * grid.spacing(0), j * grid.spacing(1);
    return a;
}

/// The grid's material on `triangles` over its nodes, at their present positions.
TriangleSurface with_material(const GridSurface& surface, const Triangles& triangles,
                              const Points& rest, const Coordinates& a) {
    const SurfaceGrid& grid = surface.grid;
    TriangleSurface out{.triangles = triangles, .rest = rest, .coordinates = {}, .material = {}};
    out.coordinates.resize(triangles.rows(), 6);
    const Mat2 metric =
        metric_weights(grid, surface.parameters)
            .cwiseQuotient(metric_weights(grid, Parameters::kResolutionIndependent));
    const Mat2 bending =
        bending_weights(grid, surface.bending)
            .cwiseQuotient(bending_weights(grid, Parameters::kResolutionIndependent));
    for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
        SurfaceMaterial mean;
        mean.mass_kg = 0;
        // Across the seam of a tube, a2 continues beyond 1.
        int max = 0;
        for (int k = 0; k < 3; ++k) max = std::max(max, triangles(t, k) % grid.n);
        for (int k = 0; k < 3; ++k) {
            const int node = triangles(t, k);
            const bool beyond = grid.closed && node % grid.n == 0 && max == grid.n - 1;
            out.coordinates(t, 2 * k) = a(node, 0);
            out.coordinates(t, 2 * k + 1) = a(node, 1) + (beyond ? 1 : 0);
            const SurfaceMaterial& material = material_of(surface, node);
            mean.elastic_n_per_m3 += material.elastic_n_per_m3.cwiseProduct(metric) / 3;
            mean.damping_ns_per_m3 += material.damping_ns_per_m3.cwiseProduct(metric) / 3;
            mean.bending_n_per_m += material.bending_n_per_m.cwiseProduct(bending) / 3;
            mean.mass_kg += material.mass_kg / 3;
            mean.drag_ns_per_m += material.drag_ns_per_m / 3;
        }
        out.material.push_back(mean);
    }
    return out;
}

/// Moves inner nodes by up to `fraction` of the spacing, inside the cell that they move into.
void shake(const GridSurface& surface, double fraction, unsigned seed, Points& rest,
           Coordinates& a) {
    const SurfaceGrid& grid = surface.grid;
    std::mt19937 random(seed);
    // std::uniform_real_distribution is not used, because its numbers differ between libraries.
    const auto part = [&] { return fraction * (2 * (random() / 4294967295.0) - 1); };
    const auto at = [&](int i, int j) {
        return point(surface.rest, grid.index(i, (j + grid.n) % grid.n));
    };
    for (int i = 1; i + 1 < grid.m; ++i)
        for (int j = grid.closed ? 0 : 1; j < (grid.closed ? grid.n : grid.n - 1); ++j) {
            const double u = part(), v = part();
            const int node = grid.index(i, j), di = u < 0 ? -1 : 1, dj = v < 0 ? -1 : 1;
            const double s = std::abs(u), t = std::abs(v);
            a.row(node) += Eigen::RowVector2d(u * grid.spacing(0), v * grid.spacing(1));
            rest.row(node) = ((1 - s) * ((1 - t) * at(i, j) + t * at(i, j + dj)) +
                              s * ((1 - t) * at(i + di, j) + t * at(i + di, j + dj)))
                                 .transpose();
        }
}

double angle_at(const Vec3& p, const Vec3& q, const Vec3& r) {
    const Vec3 e = q - p, f = r - p;
    return std::atan2(e.cross(f).norm(), e.dot(f));
}

/// Cuts a cell along its other diagonal when the angles opposite to that diagonal have the smaller sum.
void cut_by_angles(const Points& rest, Triangles& triangles) {
    for (Eigen::Index t = 0; t + 1 < triangles.rows(); t += 2) {
        // The cell's corners in turn: triangles (w, x, y) and (w, y, z), in either order.
        const bool in_order = triangles(t, 2) == triangles(t + 1, 1);
        const Eigen::Index first = in_order ? t : t + 1, second = in_order ? t + 1 : t;
        const int w = triangles(first, 0), x = triangles(first, 1), y = triangles(first, 2),
                  z = triangles(second, 2);
        const Vec3 pw = point(rest, w), px = point(rest, x), py = point(rest, y),
                   pz = point(rest, z);
        if (angle_at(px, pw, py) + angle_at(pz, pw, py) <=
            angle_at(pw, px, pz) + angle_at(py, px, pz))
            continue;
        triangles.row(first) << w, x, z;
        triangles.row(second) << x, y, z;
    }
}

}  // namespace

TriangleSurface triangulated(const GridSurface& surface) {
    return with_material(surface, surface_triangles(surface.grid), surface.rest,
                         grid_coordinates(surface.grid));
}

TriangleSurface irregularly_triangulated(const GridSurface& surface, double fraction,
                                         unsigned seed) {
    Points rest = surface.rest;
    Coordinates a = grid_coordinates(surface.grid);
    shake(surface, fraction, seed, rest, a);
    Triangles triangles = surface_triangles(surface.grid);
    cut_by_angles(rest, triangles);
    return with_material(surface, triangles, rest, a);
}

CornerCoordinates fibre_coordinates(const Triangles& triangles, const Points& rest,
                                    const Points& fibre) {
    CornerCoordinates coordinates(triangles.rows(), 6);
    for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
        const Vec3 p = point(rest, triangles(t, 0));
        const Vec3 normal =
            (point(rest, triangles(t, 1)) - p).cross(point(rest, triangles(t, 2)) - p).normalized();
        const Vec3 given = fibre.row(t).transpose();
        const Vec3 along = (given - given.dot(normal) * normal).normalized();
        const Vec3 across = normal.cross(along);
        for (int k = 0; k < 3; ++k) {
            const Vec3 d = point(rest, triangles(t, k)) - p;
            coordinates(t, 2 * k) = d.dot(along);
            coordinates(t, 2 * k + 1) = d.dot(across);
        }
    }
    return coordinates;
}

const SurfaceMaterial& material_of(const TriangleSurface& surface, Eigen::Index triangle) {
    assert(!surface.material.empty());
    return surface.material.size() == 1 ? surface.material.front()
                                        : surface.material[static_cast<std::size_t>(triangle)];
}

Flat coordinates_of(const TriangleSurface& surface, Eigen::Index triangle) {
    return Eigen::Map<const Flat>(surface.coordinates.row(triangle).data());
}

double area_of(const Flat& corners) {
    const Vec2 u = corners.col(1) - corners.col(0), v = corners.col(2) - corners.col(0);
    return 0.5 * std::abs(u[0] * v[1] - u[1] * v[0]);
}

void check(const TriangleSurface& surface, const std::string& place) {
    const Eigen::Index count = surface.triangles.rows(), points = surface.rest.rows();
    for (Eigen::Index node = 0; node < points; ++node)
        if (!surface.rest.row(node).allFinite())
            throw Error(place + "/rest/" + std::to_string(node), "three finite numbers",
                        "one that is not");
    if (surface.coordinates.rows() != count)
        throw Error(place + "/coordinates", "one row per triangle, " + std::to_string(count),
                    std::to_string(surface.coordinates.rows()));
    for (Eigen::Index t = 0; t < count; ++t) {
        const std::string triangle = place + "/triangles/" + std::to_string(t);
        for (int k = 0; k < 3; ++k)
            if (surface.triangles(t, k) < 0 || surface.triangles(t, k) >= points)
                throw Error(triangle, "points 0 to " + std::to_string(points - 1),
                            std::to_string(surface.triangles(t, k)));
        const Vec3 p = point(surface.rest, surface.triangles(t, 0));
        const Vec3 e1 = point(surface.rest, surface.triangles(t, 1)) - p;
        const Vec3 e2 = point(surface.rest, surface.triangles(t, 2)) - p;
        constexpr double kMinShape = 1e-9;  // area over sum of squared edges
        if (!(e1.cross(e2).norm() > kMinShape * (e1.squaredNorm() + e2.squaredNorm())))
            throw Error(triangle, "an area at rest", "none");
        const Flat a = coordinates_of(surface, t);
        const double squared =
            (a.col(1) - a.col(0)).squaredNorm() + (a.col(2) - a.col(0)).squaredNorm();
        if (!(area_of(a) > kMinShape * squared))
            throw Error(place + "/coordinates/" + std::to_string(t),
                        "an area in material coordinates", a.allFinite() ? "none" : "NaN");
    }
    if (surface.material.size() == 1) {
        check(surface.material.front(), place + "/material");
        return;
    }
    if (static_cast<Eigen::Index>(surface.material.size()) != count)
        throw Error(place + "/material",
                    "1 material or " + std::to_string(count) + ", one per triangle",
                    std::to_string(surface.material.size()));
    for (std::size_t t = 0; t < surface.material.size(); ++t)
        check(surface.material[t], place + "/material/" + std::to_string(t));
}

Eigen::VectorXd node_mass(const TriangleSurface& surface) {
    Eigen::VectorXd mass = Eigen::VectorXd::Zero(surface.rest.rows());
    for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t) {
        const double third =
            material_of(surface, t).mass_kg * area_of(coordinates_of(surface, t)) / 3;
        for (int k = 0; k < 3; ++k) mass[surface.triangles(t, k)] += third;
    }
    return mass;
}

}  // namespace risorius::tissue
