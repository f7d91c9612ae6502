// SPDX-License-Identifier: MIT
#include "risorius/render/detail/texture_square.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "risorius/core/srgb.h"

namespace risorius::render {

std::uint8_t srgb_byte(double linear) {
    return static_cast<std::uint8_t>(
        std::lround(255 * std::clamp(risorius::srgb_of_linear(linear), 0.0, 1.0)));
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
