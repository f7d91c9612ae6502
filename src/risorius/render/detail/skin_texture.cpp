// SPDX-License-Identifier: MIT
#include "risorius/render/detail/skin_texture.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "risorius/render/detail/skin_paint.h"
#include "risorius/render/texture_square.h"

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
    const std::vector<SkinTexel> texels = skin_texels(scene, centre, image.width_px);
    for (std::size_t i = 0; i < texels.size(); ++i) {
        const SkinTexel& texel = texels[i];
        if (texel.surface < 0) continue;
        const auto corner = [&](int k) {
            const Surface& surface = scene.surfaces[static_cast<std::size_t>(texel.surface)];
            return Vec3(scene.rest.row(surface.triangles(texel.triangle, k)).transpose());
        };
        const Vec3 p =
            texel.share[0] * corner(0) + texel.share[1] * corner(1) + texel.share[2] * corner(2);
        const Vec3 root = sample(map, map_side, within_rim(paint_place(p, centre)));
        for (std::size_t k = 0; k < 3; ++k)
            image.rgba[4 * i + k] =
                srgb_byte(root[static_cast<long>(k)] * root[static_cast<long>(k)]);
        image.rgba[4 * i + 3] = 255;
    }
    fill_uncovered(image, scene.appearance.skin_tone);
    return image;
}

}  // namespace risorius::render
