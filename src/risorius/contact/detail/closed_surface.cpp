// SPDX-License-Identifier: MIT
#include "risorius/contact/detail/closed_surface.h"

#include <algorithm>
#include <cmath>

#include "risorius/core/json_cursor.h"
#include "risorius/geom/surface_topology.h"

namespace risorius::contact {

namespace {

std::string position_text(const Points& positions, int vertex) {
    return "(" + format_number(positions(vertex, 0)) + ", " + format_number(positions(vertex, 1)) +
           ", " + format_number(positions(vertex, 2)) + ") m";
}

void check_closed(const Points& positions, const Triangles& triangles,
                  const geom::SurfaceEdges& edges, const std::string& place) {
    for (int e = 0; e < edges.count(); ++e) {
        const auto [a, b] = edges.vertices[e];
        const std::string edge = place + "/edge " + std::to_string(a) + "-" + std::to_string(b);
        const int count = edges.triangle_count(e);
        if (count != 2)
            throw Error(edge, "two triangles (a closed surface)",
                        std::to_string(count) + " at " + position_text(positions, a));
        const int first = edges.triangle_begin[e];
        const auto starts_at = [&](int i) {
            return triangles(edges.triangle[first + i], edges.side[first + i]);
        };
        if (starts_at(0) == starts_at(1))
            throw Error(edge, "triangles that run along it in opposite ways",
                        "a flipped one at " + position_text(positions, a));
    }
}

}  // namespace

double enclosed_volume(const Points& positions, const Triangles& triangles) {
    double sixfold = 0;
    for (long t = 0; t < triangles.rows(); ++t) {
        const Vec3 a = positions.row(triangles(t, 0)).transpose();
        const Vec3 b = positions.row(triangles(t, 1)).transpose();
        const Vec3 c = positions.row(triangles(t, 2)).transpose();
        sixfold += a.dot(b.cross(c));
    }
    return sixfold / 6;
}

ClosedSurface::ClosedSurface(const Points& positions, const Triangles& triangles,
                             const std::string& place)
    : triangles_(triangles) {
    if (triangles.rows() == 0) throw Error(place, "a closed surface", "no triangles");
    if (!positions.allFinite()) throw Error(place, "finite positions", "NaN or inf");
    for (long t = 0; t < triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k)
            if (triangles(t, k) < 0 || triangles(t, k) >= positions.rows())
                throw Error(place + "/triangle " + std::to_string(t),
                            "vertices below " + std::to_string(positions.rows()),
                            std::to_string(triangles(t, k)));
    const geom::SurfaceEdges edges = geom::surface_edges(triangles);
    check_closed(positions, triangles, edges, place);
    const double volume = enclosed_volume(positions, triangles);
    if (!(volume > 0))
        throw Error(place, "a surface that faces outwards, of volume > 0",
                    format_number(volume) + " m3");

    edge_count_ = edges.count();
    edge_of_side_.resize(triangles.rows(), 3);
    for (int e = 0; e < edge_count_; ++e)
        for (int i = edges.triangle_begin[e]; i < edges.triangle_begin[e + 1]; ++i)
            edge_of_side_(edges.triangle[i], edges.side[i]) = e;
    tree_ = geom::SurfaceTree(positions, triangles);
    refit(positions);
}

void ClosedSurface::refit(const Points& positions) {
    tree_.refit(positions);
    face_normals_.setZero(triangles_.rows(), 3);
    edge_normals_.setZero(edge_count_, 3);
    vertex_normals_.setZero(positions.rows(), 3);
    for (long t = 0; t < triangles_.rows(); ++t) {
        Vec3 corner[3];
        for (int k = 0; k < 3; ++k) corner[k] = positions.row(triangles_(t, k)).transpose();
        const Vec3 normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
        face_normals_.row(t) = normal.transpose();
        for (int k = 0; k < 3; ++k) {
            edge_normals_.row(edge_of_side_(t, k)) += normal.transpose();
            const Vec3 u = corner[(k + 1) % 3] - corner[k], v = corner[(k + 2) % 3] - corner[k];
            const double angle = std::atan2(u.cross(v).norm(), u.dot(v));
            vertex_normals_.row(triangles_(t, k)) += angle * normal.transpose();
        }
    }
    edge_normals_.rowwise().normalize();
    vertex_normals_.rowwise().normalize();
}

std::optional<Nearest> ClosedSurface::nearest(const Vec3& p, double max_distance_m) const {
    const auto found = tree_.closest(p, max_distance_m);
    if (!found) return std::nullopt;
    Nearest nearest;
    static_cast<geom::SurfacePoint&>(nearest) = *found;

    // On a corner, on a side, or inside the face.
    constexpr double kOnSide = 1e-12;
    int corner = -1, off_corner = -1, zeros = 0;
    for (int k = 0; k < 3; ++k) {
        if (found->barycentric(k) <= kOnSide) {
            ++zeros;
            off_corner = k;
        } else {
            corner = k;
        }
    }
    const int t = found->triangle;
    if (zeros == 2)
        nearest.normal = vertex_normals_.row(triangles_(t, corner)).transpose();
    else if (zeros == 1)
        nearest.normal = edge_normals_.row(edge_of_side_(t, (off_corner + 1) % 3)).transpose();
    else
        nearest.normal = face_normals_.row(t).transpose();
    const double distance = std::sqrt(found->squared_distance);
    nearest.gap_m = (p - found->point).dot(nearest.normal) < 0 ? -distance : distance;
    return nearest;
}

}  // namespace risorius::contact
