// SPDX-License-Identifier: MIT
/// \file
/// Averages N x N samples per pixel in linear light over the background.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "risorius/core/image.h"
#include "risorius/render/offscreen_view.h"

namespace risorius::render {

/// A rectangle of a picture, px from its top left corner.
struct Tile {
    int x, y, width, height;
};

/// Returns the mean of pictures of equal size, computed in linear light.
Image mean_of(const std::vector<Image>& pictures);

class Resolve {
  public:
    explicit Resolve(const Background& background);

    /// Writes one tile. `samples`: RGBA bytes, rows from the bottom, `supersampling` times as wide and high as the tile. Their
    /// colour was multiplied by alpha in linear light and then encoded as sRGB.
    void operator()(const std::vector<std::uint8_t>& samples, int supersampling, const Tile& tile,
                    Image& image) const;

    /// Resolves one row of `count` pixels. `samples`: the first sample of the lowest row of samples; rows are `sample_row` bytes
    /// apart.
    void row(const std::uint8_t* samples, std::size_t supersampling, std::size_t sample_row,
             std::size_t count, std::uint8_t* out) const;
    /// Does the same for opaque samples; their alpha is ignored.
    void opaque_row(const std::uint8_t* samples, std::size_t supersampling, std::size_t sample_row,
                    std::size_t count, std::uint8_t* out) const;
    /// Writes `count` pixels of background.
    void empty_row(std::size_t count, std::uint8_t* out) const;

  private:
    bool transparent_;
    std::array<std::uint8_t, 3> background_;
    std::array<std::uint8_t, 4> nothing_{};          ///< a pixel without samples
    std::array<std::uint16_t, 256> linear_of_byte_;  ///< sRGB byte -> linear, 65535 = 1
    std::vector<std::uint8_t> byte_of_linear_;       ///< linear 0..65535 -> nearest sRGB byte
};

}  // namespace risorius::render
