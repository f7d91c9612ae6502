// SPDX-License-Identifier: MIT
/// \file
/// Pictures in memory: 8 bits per channel, sRGB-encoded colour, straight (not premultiplied) alpha.
#pragma once

#include <cstdint>
#include <vector>

namespace risorius {

/// A picture, RGBA. All pixels are transparent black at first.
struct Image {
    int width_px = 0;
    int height_px = 0;
    std::vector<std::uint8_t> rgba;   ///< height x width x 4, rows from the top
    std::vector<std::uint16_t> deep;  ///< the same with 16 bits per channel, or empty

    Image() = default;
    Image(int width, int height)
        : width_px(width),
          height_px(height),
          rgba(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4, 0) {}

    std::uint8_t* pixel(int x, int y) { return rgba.data() + offset(x, y); }
    const std::uint8_t* pixel(int x, int y) const { return rgba.data() + offset(x, y); }

  private:
    std::size_t offset(int x, int y) const {
        return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) +
                static_cast<std::size_t>(x)) *
               4;
    }
};

}  // namespace risorius
