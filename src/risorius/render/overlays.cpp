// SPDX-License-Identifier: MIT
#include "risorius/render/overlays.h"

#include <algorithm>
#include <cmath>

#include "risorius/render/detail/blend.h"
#include "risorius/render/lettering.h"

namespace risorius::render {

namespace {

const Vec3 kWireInk(0.02, 0.10, 0.30), kDotInk(0.98, 0.80, 0.10), kDotRim(0.05, 0.05, 0.05);
/// Tolerances of the depth test: lines lie on the surface that may hide them; landmarks may lie below it, as in the corner of the
/// mouth.
constexpr double kWireAbove_m = 1e-3, kDotAbove_m = 5e-3;
constexpr int kReadable_px = 700;

void blend_at(int x, int y, const Vec3& ink, double cover, Image& image) {
    if (x < 0 || y < 0 || x >= image.width_px || y >= image.height_px || cover <= 0) return;
    blend(image.pixel(x, y), ink, cover);
}

/// Antialiased line between two points of the picture; its opacity is split between the two pixels on either side of it (Wu
/// 1991).
void draw_line(const Vec3& a, const Vec3& b, double opacity, const SurfacePasses& passes,
               const SeenSurface& seen, Image& image) {
    const Vec3 way = b - a;
    const bool steep = std::abs(way.y()) > std::abs(way.x());
    const double length = std::max(std::abs(way.x()), std::abs(way.y()));
    const int steps = std::max(1, static_cast<int>(std::ceil(length)));
    for (int i = 0; i < steps; ++i) {
        const Vec3 at = a + way * ((i + 0.5) / steps);
        if (!passes.is_seen(seen, at, kWireAbove_m)) continue;
        const double cross = (steep ? at.x() : at.y()) - 0.5;
        const int near = static_cast<int>(std::floor(cross));
        const double beyond = cross - near;
        const int along = static_cast<int>(std::floor(steep ? at.y() : at.x()));
        for (const auto& [pixel, fraction] : {std::pair{near, 1 - beyond}, {near + 1, beyond}})
            blend_at(steep ? pixel : along, steep ? along : pixel, kWireInk, opacity * fraction,
                     image);
    }
}

void draw_dot(const Vec3& at, double radius, Image& image) {
    const int reach = static_cast<int>(radius) + 2;
    const int cx = static_cast<int>(at.x()), cy = static_cast<int>(at.y());
    for (int y = cy - reach; y <= cy + reach; ++y)
        for (int x = cx - reach; x <= cx + reach; ++x) {
            const double away = std::hypot(x + 0.5 - at.x(), y + 0.5 - at.y());
            blend_at(x, y, kDotRim, 0.8 * std::clamp(radius + 1.5 - away, 0.0, 1.0), image);
            blend_at(x, y, kDotInk, std::clamp(radius + 0.5 - away, 0.0, 1.0), image);
        }
}

}  // namespace

void draw_wire(const std::vector<std::array<int, 2>>& edges, const SurfacePasses& passes,
               const SeenSurface& seen, Image& image) {
    for (const auto& [first, second] : edges) {
        const Vec3 a = passes.in_picture(seen.positions.row(first).transpose()),
                   b = passes.in_picture(seen.positions.row(second).transpose());
        const double length = (b - a).head<2>().norm();
        draw_line(a, b, std::clamp(length / 12, 0.12, 0.75), passes, seen, image);
    }
}

void draw_landmarks(const std::vector<NamedPoint>& points, const SurfacePasses& passes,
                    const SeenSurface& seen, Image& image) {
    const int side = std::min(image.width_px, image.height_px);
    const double radius = std::max(1.2, 0.0035 * side);
    std::vector<std::pair<const NamedPoint*, Vec3>> shown;
    for (const NamedPoint& point : points) {
        const Vec3 at = passes.in_picture(point.at);
        if (passes.is_seen(seen, at, kDotAbove_m)) shown.emplace_back(&point, at);
    }
    for (const auto& [point, at] : shown) draw_dot(at, radius, image);
    if (side < kReadable_px) return;
    const TextStyle style{.height_px = 0.009 * side, .ink = 0.05, .rim = 0.7};
    for (const auto& [point, at] : shown)
        write_text(point->name, {at.x() + radius + 2, at.y() - radius}, style, image);
}

}  // namespace risorius::render
