// SPDX-License-Identifier: MIT
#include "risorius/render/texture_square.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "risorius/core/srgb.h"

namespace risorius::render {

std::uint8_t srgb_byte(double linear) {
    return static_cast<std::uint8_t>(
        std::lround(255 * std::clamp(risorius::srgb_of_linear(linear), 0.0, 1.0)));
}

std::vector<SkinTexel> skin_texels(const Scene& scene, const Vec3& centre, int side_px) {
    const std::size_t count = static_cast<std::size_t>(side_px) * static_cast<std::size_t>(side_px);
    std::vector<SkinTexel> out(count);
    std::vector<float> outermost(count, 0.0F);
    for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
        const Surface& surface = scene.surfaces[s];
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
                    const std::size_t texel =
                        static_cast<std::size_t>(y) * static_cast<std::size_t>(side_px) +
                        static_cast<std::size_t>(x);
                    const auto distance = static_cast<float>(before_all + (p - centre).norm());
                    if (distance < outermost[texel]) continue;
                    outermost[texel] = distance;
                    out[texel] = {static_cast<int>(s), static_cast<int>(f), {1 - u - v, u, v}};
                }
        }
    }
    return out;
}

void fill_uncovered(Image& image, const Vec3& otherwise) {
    constexpr int kPixels = 6;
    for (int step = 0; step < kPixels; ++step) {
        const Image before = image;
        for (int y = 0; y < image.height_px; ++y)
            for (int x = 0; x < image.width_px; ++x) {
                if (before.pixel(x, y)[3] != 0) continue;
                for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
                    const int nx = x + dx, ny = y + dy;
                    if (nx < 0 || ny < 0 || nx >= image.width_px || ny >= image.height_px ||
                        before.pixel(nx, ny)[3] == 0)
                        continue;
                    std::copy_n(before.pixel(nx, ny), 4, image.pixel(x, y));
                    break;
                }
            }
    }
    for (int y = 0; y < image.height_px; ++y)
        for (int x = 0; x < image.width_px; ++x) {
            std::uint8_t* pixel = image.pixel(x, y);
            if (pixel[3] != 0) continue;
            for (int k = 0; k < 3; ++k)
                pixel[k] = static_cast<std::uint8_t>(std::lround(255 * otherwise[k]));
            pixel[3] = 255;
        }
}

Vec3 mean_colour(const Image& image) {
    Vec3 sum = Vec3::Zero();
    double count = 0;
    for (int y = 0; y < image.height_px; ++y)
        for (int x = 0; x < image.width_px; ++x) {
            const std::uint8_t* pixel = image.pixel(x, y);
            if (pixel[3] == 0) continue;
            sum += Vec3(pixel[0], pixel[1], pixel[2]);
            ++count;
        }
    return sum / (255 * std::max(count, 1.0));
}

}  // namespace risorius::render
