// SPDX-License-Identifier: MIT
/// \file
/// Alpha blending of one pixel onto a finished picture.
#pragma once

#include <cmath>
#include <cstdint>

#include "risorius/core/srgb.h"
#include "risorius/core/types.h"

namespace risorius::render {

/// Blends a colour over a pixel of RGBA bytes with straight (not premultiplied) alpha. `srgb`: the colour, 0..1. `cover`: its
/// opacity, 0..1.
inline void blend(std::uint8_t* pixel, const Vec3& srgb, double cover) {
    const double under = pixel[3] / 255.0 * (1 - cover), alpha = cover + under;
    if (alpha <= 0) return;
    for (int k = 0; k < 3; ++k)
        pixel[k] = static_cast<std::uint8_t>(
            std::lround((255 * srgb[k] * cover + pixel[k] * under) / alpha));
    pixel[3] = static_cast<std::uint8_t>(std::lround(255 * alpha));
}

using risorius::srgb_of_linear;
/// Encodes linear light as sRGB, both 0..1.
inline Vec3 srgb_of_linear(const Vec3& linear) {
    return linear.unaryExpr([](double light) { return risorius::srgb_of_linear(light); });
}

}  // namespace risorius::render
