// SPDX-License-Identifier: MIT
#include "risorius/face/skin/detail/palate.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace risorius::face {

namespace {

constexpr double kAside_mm = 8,
                 kAcross_mm = 4;  // from the middle to its last column, and from one to the next
// Above the dorsum at rest: the height of the vault where a head has no roof, and what is too high to be one. Estimates.
constexpr double kVault_mm = 15.5, kTooHigh_mm = 30;
constexpr double kBoneNear_mm = 4;  // of a bone whose triangles are not known, sideways
constexpr double kLayer_mm = 4;     // thickness of what counts as its lowest surface
constexpr double kClear_mm = 0.5;   // below this, a surface is the tongue's own

struct RoofHit {
    double y = 1e300;
    std::vector<std::pair<int, double>> of;
};

// The lowest crossing of a vertical line above a point with triangles.
void meet(const Triangles& triangles, const Points& vertices, const Vec3& from, RoofHit& best) {
    for (long f = 0; f < triangles.rows(); ++f) {
        std::array<Vec2, 3> corner;  // z and x from the line
        for (int k = 0; k < 3; ++k)
            corner[static_cast<std::size_t>(k)] = {vertices(triangles(f, k), 2) - from.z(),
                                                   vertices(triangles(f, k), 0) - from.x()};
        const auto cross = [](const Vec2& a, const Vec2& b) {
            return a.x() * b.y() - a.y() * b.x();
        };
        const Vec3 part(cross(corner[1], corner[2]), cross(corner[2], corner[0]),
                        cross(corner[0], corner[1]));
        const double area = part.sum();
        if (area == 0 || (part / area).minCoeff() < -1e-9) continue;
        double y = 0;
        for (int k = 0; k < 3; ++k) y += part[k] / area * vertices(triangles(f, k), 1);
        if (y <= from.y() || y >= best.y) continue;
        best.y = y;
        best.of.clear();
        for (int k = 0; k < 3; ++k) best.of.emplace_back(triangles(f, k), part[k] / area);
    }
}

// Bones without triangles (gums, and a palate that is one piece with them): a mean of the lowest vertices near the line.
void meet(const std::vector<int>& bone, const Points& vertices, const Vec3& from, double near_m,
          double layer_m, RoofHit& best) {
    double lowest = best.y;
    const auto away = [&](int v) {
        return std::hypot(vertices(v, 0) - from.x(), vertices(v, 2) - from.z());
    };
    for (const int v : bone)
        if (vertices(v, 1) > from.y() && away(v) < near_m)
            lowest = std::min(lowest, vertices(v, 1));
    if (lowest >= best.y) return;
    RoofHit hit{0, {}};
    double sum = 0;
    for (const int v : bone) {
        const double far = away(v);
        if (vertices(v, 1) <= from.y() || far >= near_m || vertices(v, 1) > lowest + layer_m)
            continue;
        const double weight = (1 - far / near_m) * (1 - far / near_m) + 1e-6;
        hit.of.emplace_back(v, weight);
        sum += weight;
    }
    for (auto& [v, weight] : hit.of) {
        weight /= sum;
        hit.y += weight * vertices(v, 1);
    }
    best = std::move(hit);
}

}  // namespace

double PalateHeights::at(double x, double z) const {
    const auto place = [](double from, double step, double at, std::size_t count) {
        return std::clamp((at - from) / step, 0.0, static_cast<double>(count - 1) - 1e-9);
    };
    const double across = place(from_x, step_x_m, x, y.front().size()),
                 along = place(from_z, step_z_m, z, y.size());
    const auto i = static_cast<std::size_t>(across), k = static_cast<std::size_t>(along);
    const double s = across - static_cast<double>(i), t = along - static_cast<double>(k);
    return (1 - t) * ((1 - s) * y[k][i] + s * y[k][i + 1]) +
           t * ((1 - s) * y[k + 1][i] + s * y[k + 1][i + 1]);
}

Palate::Palate(const rig::Head& head, double from_z, double to_z,
               const std::vector<double>& dorsum_y)
    : grid_{-head.mm(kAside_mm),
            from_z,
            head.mm(kAcross_mm),
            (to_z - from_z) / static_cast<double>(dorsum_y.size() - 1),
            {}} {
    std::vector<int> bone;
    for (long v = 0; v < head.vertices.rows(); ++v)
        if (head.carrier[static_cast<std::size_t>(v)] == rig::Carrier::kSkull)
            bone.push_back(static_cast<int>(v));
    const double top = *std::max_element(dorsum_y.begin(), dorsum_y.end());
    for (std::size_t k = 0; k < dorsum_y.size(); ++k) {
        auto& row = rows_.emplace_back();
        for (double aside_mm = -kAside_mm; aside_mm <= kAside_mm; aside_mm += kAcross_mm) {
            const Vec3 from(head.mm(aside_mm), dorsum_y[k] + head.mm(kClear_mm),
                            from_z + static_cast<double>(k) * grid_.step_z_m);
            RoofHit hit;
            hit.y = top + head.mm(kTooHigh_mm);
            meet(head.lining, head.vertices, from, hit);
            meet(head.skin, head.vertices, from, hit);
            meet(bone, head.vertices, from, head.mm(kBoneNear_mm), head.mm(kLayer_mm), hit);
            found_ = found_ || !hit.of.empty();
            row.push_back({std::move(hit.of), top + head.mm(kVault_mm)});
        }
    }
}

PalateHeights Palate::heights(const Points& vertices) const {
    PalateHeights out = grid_;
    for (const std::vector<Point>& row : rows_) {
        std::vector<double>& heights = out.y.emplace_back();
        for (const Point& point : row) {
            double y = point.of.empty() ? point.y : 0;
            for (const auto& [v, weight] : point.of) y += weight * vertices(v, 1);
            heights.push_back(y);
        }
    }
    return out;
}

}  // namespace risorius::face
