// SPDX-License-Identifier: MIT
#include "risorius/blendshapes/detail/shape_measures.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

namespace risorius::blendshapes {

Stretch stretch_of(const Triangles& triangles, const Points& rest, const Points& moved) {
    constexpr double kSliver = 1e-3;  // height over side below which a triangle is ignored
    Stretch out;
    std::vector<std::pair<double, double>> by_stretch;  // stretch and area of each triangle
    double area = 0;
    for (long f = 0; f < triangles.rows(); ++f) {
        const auto edge = [&](const Points& points, int k) -> Vec3 {
            return (points.row(triangles(f, k)) - points.row(triangles(f, 0))).transpose();
        };
        const Vec3 a = edge(rest, 1), b = edge(rest, 2);
        const double twice_area = a.cross(b).norm(),
                     longest = std::max({a.squaredNorm(), b.squaredNorm(), (a - b).squaredNorm()});
        if (twice_area <= kSliver * longest) continue;
        // Coordinates in the plane of the rest triangle
        const Vec3 u = a.normalized(), w = a.cross(b).normalized().cross(u);
        Eigen::Matrix2d flat;
        flat << a.dot(u), b.dot(u), a.dot(w), b.dot(w);
        Eigen::Matrix<double, 3, 2> now;
        now << edge(moved, 1), edge(moved, 2);
        const Eigen::Matrix<double, 3, 2> F = now * flat.inverse();
        const Eigen::Matrix2d C = F.transpose() * F;
        const double mean = C.trace() / 2, spread = std::hypot((C(0, 0) - C(1, 1)) / 2, C(0, 1));
        const double max = std::sqrt(mean + spread), min = std::sqrt(std::max(0.0, mean - spread));
        out.max = std::max(out.max, max);
        out.min = std::min(out.min, min);
        by_stretch.emplace_back(max, twice_area);
        area += twice_area;
    }
    std::sort(by_stretch.begin(), by_stretch.end());
    double below = 0;
    for (const auto& [stretch, part] : by_stretch) {
        below += part;
        if (below < 0.99 * area) continue;
        out.max_of_99 = std::max(1.0, stretch);
        break;
    }
    return out;
}

std::optional<geom::MirrorPairs> mirror_of(const Triangles& skin, const Points& rest) {
    geom::MirrorPairs pairs = geom::find_mirror_pairs(skin, rest, Vec3::UnitX(), 0.0);
    if (!pairs.found()) return std::nullopt;
    return pairs;
}

double asymmetry_m(const geom::MirrorPairs& mirror, const Points& one, const Points& other) {
    double worst = 0;
    for (std::size_t v = 0; v < mirror.partner.size(); ++v) {
        const int partner = mirror.partner[v];
        if (partner < 0) continue;
        const Vec3 here = one.row(static_cast<long>(v)).transpose(),
                   there = other.row(partner).transpose();
        worst = std::max(worst, (here - mirror.reflect(there)).norm());
    }
    return worst;
}

Points with_mirror_image(const geom::MirrorPairs& mirror, const Points& field,
                         const Points& other) {
    Points out = field;
    for (std::size_t v = 0; v < mirror.partner.size(); ++v)
        if (const int partner = mirror.partner[v]; partner >= 0)
            out.row(static_cast<long>(v)) =
                mirror.reflect(Vec3(other.row(partner).transpose())).transpose();
    return out;
}

Points mean_with_mirror_image(const geom::MirrorPairs& mirror, const Points& field,
                              const Points& other) {
    return 0.5 * (field + with_mirror_image(mirror, field, other));
}

}  // namespace risorius::blendshapes
