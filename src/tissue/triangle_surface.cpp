#include "tissue/triangle_surface.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/error.h"

namespace risorius::tissue {

namespace {

using Flat = Eigen::Matrix<double, 2, 3>;

Vec3 point(const Points& x, int node) { return x.row(node).transpose(); }

}  // namespace

TriangleSurface triangulated(const GridSurface& surface) {
    const SurfaceGrid& grid = surface.grid;
    TriangleSurface out{.triangles = surface_triangles(grid),
                        .rest = surface.rest,
                        .coordinates = {},
                        .material = {}};
    out.coordinates.resize(out.triangles.rows(), 6);
    const Mat2 metric =
        metric_weights(grid, surface.parameters)
            .cwiseQuotient(metric_weights(grid, Parameters::kResolutionIndependent));
    const Mat2 bending =
        bending_weights(grid, surface.bending)
            .cwiseQuotient(bending_weights(grid, Parameters::kResolutionIndependent));
    for (Eigen::Index t = 0; t < out.triangles.rows(); ++t) {
        SurfaceMaterial mean;
        mean.mass_kg = 0;
        // Across the seam of a tube a2 goes on beyond 1.
        int most = 0;
        for (int k = 0; k < 3; ++k) most = std::max(most, out.triangles(t, k) % grid.n);
        for (int k = 0; k < 3; ++k) {
            const int node = out.triangles(t, k), i = node / grid.n, j = node % grid.n;
            const bool beyond = grid.closed && j == 0 && most == grid.n - 1;
            out.coordinates(t, 2 * k) = i * grid.spacing(0);
            out.coordinates(t, 2 * k + 1) = (beyond ? grid.n : j) * grid.spacing(1);
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
        constexpr double kLeastShape = 1e-9;  // area over squared edges
        if (!(e1.cross(e2).norm() > kLeastShape * (e1.squaredNorm() + e2.squaredNorm())))
            throw Error(triangle, "an area at rest", "none");
        const Flat a = coordinates_of(surface, t);
        const double squared =
            (a.col(1) - a.col(0)).squaredNorm() + (a.col(2) - a.col(0)).squaredNorm();
        if (!(area_of(a) > kLeastShape * squared))
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
