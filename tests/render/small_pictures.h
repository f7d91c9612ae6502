// SPDX-License-Identifier: MIT
/// \file
/// Small pictures of the round head, and what is read off them.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "risorius/core/image.h"
#include "risorius/render/offscreen_view.h"

namespace risorius::render {

inline ViewOptions small(const std::string& camera = "front") {
    return {.width_px = 192, .height_px = 192, .camera = camera};
}

/// Mean of the pixels within `reach` of a place, 0..255.
inline std::array<double, 3> mean_colour(const Image& image, const Vec2& at, int reach) {
    std::array<double, 3> sum{0, 0, 0};
    int count = 0;
    for (int dy = -reach; dy <= reach; ++dy)
        for (int dx = -reach; dx <= reach; ++dx) {
            const std::uint8_t* p =
                image.pixel(static_cast<int>(at.x()) + dx, static_cast<int>(at.y()) + dy);
            for (std::size_t k = 0; k < 3; ++k) sum[k] += p[k];
            ++count;
        }
    for (double& s : sum) s /= count;
    return sum;
}

inline double brightness_of(const std::array<double, 3>& rgb) {
    return (rgb[0] + rgb[1] + rgb[2]) / 3;
}

inline std::uint64_t fingerprint(const Image& image) {
    std::uint64_t hash = 14695981039346656037ULL;  // FNV-1a
    for (const std::uint8_t byte : image.rgba) hash = (hash ^ byte) * 1099511628211ULL;
    return hash;
}

}  // namespace risorius::render
