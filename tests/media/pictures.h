// SPDX-License-Identifier: MIT
/// \file
/// Pictures that the tests write and read back.
#pragma once

#include "risorius/core/image.h"
#include "temporary_folder.h"

namespace risorius::media {

/// Size of the tests' videos.
inline constexpr int kWidth = 64, kHeight = 48;

/// Noise that no codec can predict: pixel values of a linear congruential generator, opaque by default.
inline Image noise(int width, int height, unsigned seed, bool opaque = true) {
    Image image(width, height);
    std::uint32_t state = seed * 2654435761u + 1;
    for (std::size_t i = 0; i < image.rgba.size(); ++i) {
        state = state * 1664525u + 1013904223u;
        image.rgba[i] = opaque && i % 4 == 3 ? 255 : static_cast<std::uint8_t>(state >> 24);
    }
    return image;
}

inline Image flat(int width, int height, int red, int green, int blue) {
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            std::uint8_t* p = image.pixel(x, y);
            p[0] = static_cast<std::uint8_t>(red);
            p[1] = static_cast<std::uint8_t>(green);
            p[2] = static_cast<std::uint8_t>(blue);
            p[3] = 255;
        }
    return image;
}

}  // namespace risorius::media
