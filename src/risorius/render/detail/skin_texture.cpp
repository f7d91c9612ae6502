// SPDX-License-Identifier: MIT
#include "risorius/render/detail/skin_texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "risorius/render/detail/skin_paint.h"
#include "risorius/render/detail/texture_square.h"

namespace risorius::render {
namespace {

/// The back of the head lies on the rim of the map. The paint leaves out the triangles around its very middle, so places are kept
/// inside the rim.
Vec2 within_rim(const Vec2& place) {
    constexpr double kRim = 0.487;
    const Vec2 off = place - Vec2(0.5, 0.5);
    return Vec2(0.5, 0.5) + off * std::min(1.0, kRim / std::max(off.norm(), 1e-9));
}

/// Bilinear interpolation of the map, in square roots of linear light.
Vec3 sample(const std::vector<std::uint8_t>& map, int side, const Vec2& place) {
    const double x = std::clamp(place.x() * side - 0.5, 0.0, side - 1.001),
                 y = std::clamp(place.y() * side - 0.5, 0.0, side - 1.001);
    const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
    const double u = x - x0, v = y - y0;
    Vec3 sum = Vec3::Zero();
    for (const auto& [dx, dy, fraction] : {std::tuple{0, 0, (1 - u) * (1 - v)},
                                           {1, 0, u * (1 - v)},
                                           {0, 1, (1 - u) * v},
                                           {1, 1, u * v}}) {
        const std::uint8_t* texel =
            &map[4 * (static_cast<std::size_t>(y0 + dy) * static_cast<std::size_t>(side) +
                      static_cast<std::size_t>(x0 + dx))];
        sum += fraction * Vec3(texel[0], texel[1], texel[2]) / 255;
    }
    return sum;
}

}  // namespace

Image unfold_paint(const Scene& scene, const Vec3& centre, const std::vector<std::uint8_t>& map,
                   int map_side, Image image) {
    const int side_px = image.width_px;
    // Where faces overlap on the texture coordinates, as the insides and outsides of lids may, those that look outwards win, and
    // among them the outermost.
    std::vector<float> outermost(
        static_cast<std::size_t>(side_px) * static_cast<std::size_t>(side_px), 0.0F);
    for (const Surface& surface : scene.surfaces) {
        if (surface.material != Material::kSkin || surface.texcoords.rows() == 0) continue;
        for (long f = 0; f < surface.triangles.rows(); ++f) {
            std::array<Vec2, 3> at;
            std::array<Vec3, 3> rest;
            for (int k = 0; k < 3; ++k) {
                const Vec2 t = surface.texcoords.row(3 * f + k).transpose();
                at[static_cast<std::size_t>(k)] = Vec2(t.x() * side_px, (1 - t.y()) * side_px);
                rest[static_cast<std::size_t>(k)] =
                    scene.rest.row(surface.triangles(f, k)).transpose();
            }
            const Vec3 normal = (rest[1] - rest[0]).cross(rest[2] - rest[0]);
            const double before_all = normal.dot(rest[0] - centre) > 0 ? 1 : 0;  // m
            const Vec2 a = at[1] - at[0], b = at[2] - at[0];
            const double area = a.x() * b.y() - a.y() * b.x();
            if (std::abs(area) < 1e-9) continue;
            const Vec2 low = at[0].cwiseMin(at[1]).cwiseMin(at[2]),
                       high = at[0].cwiseMax(at[1]).cwiseMax(at[2]);
            const auto pixel = [&](double place) {
                return std::clamp(static_cast<int>(std::floor(place)), 0, side_px - 1);
            };
            for (int y = pixel(low.y()); y <= pixel(high.y()); ++y)
                for (int x = pixel(low.x()); x <= pixel(high.x()); ++x) {
                    const Vec2 d = Vec2(x + 0.5, y + 0.5) - at[0];
                    const double u = (d.x() * b.y() - d.y() * b.x()) / area,
                                 v = (a.x() * d.y() - a.y() * d.x()) / area;
                    if (u < 0 || v < 0 || u + v > 1) continue;
                    const Vec3 p = (1 - u - v) * rest[0] + u * rest[1] + v * rest[2];
                    float& out =
                        outermost[static_cast<std::size_t>(y) * static_cast<std::size_t>(side_px) +
                                  static_cast<std::size_t>(x)];
                    const auto distance = static_cast<float>(before_all + (p - centre).norm());
                    if (distance < out) continue;
                    out = distance;
                    const Vec3 root = sample(map, map_side, within_rim(paint_place(p, centre)));
                    for (int k = 0; k < 3; ++k) image.pixel(x, y)[k] = srgb_byte(root[k] * root[k]);
                    image.pixel(x, y)[3] = 255;
                }
        }
    }
    fill_uncovered(image, scene.appearance.skin_tone);
    return image;
}

}  // namespace risorius::render
