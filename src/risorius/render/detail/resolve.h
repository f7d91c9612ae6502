// SPDX-License-Identifier: MIT
/// \file
/// From samples to pixels: averages N x N samples in linear light over the background.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "risorius/core/image.h"
#include "risorius/render/offscreen_view.h"

namespace risorius::render {

/// Part of a picture, px from its top left corner.
struct Tile {
    int x, y, width, height;
};

/// Mean in linear light of pictures of one size.
Image mean_of(const std::vector<Image>& pictures);

class Resolve {
  public:
    explicit Resolve(const Background& background);

    /// `samples`: rows from the bottom, sRGB colour already weighted by its alpha (in linear light), supersampling times as wide and high as the tile of
    /// the picture they cover.
    void operator()(const std::vector<std::uint8_t>& samples, int supersampling, const Tile& tile,
                    Image& image) const;

    /// One row of `count` pixels, `samples` the lowest one's first sample of rows that are `sample_row` bytes apart.
    void row(const std::uint8_t* samples, std::size_t supersampling, std::size_t sample_row,
             std::size_t count, std::uint8_t* out) const;
    /// The same of samples that all cover the background, whatever their alpha says.
    void opaque_row(const std::uint8_t* samples, std::size_t supersampling, std::size_t sample_row,
                    std::size_t count, std::uint8_t* out) const;
    /// Where there are none
    void empty_row(std::size_t count, std::uint8_t* out) const;

  private:
    bool transparent_;
    std::array<std::uint8_t, 3> background_;
    std::array<std::uint8_t, 4> nothing_{};          ///< a pixel without samples
    std::array<std::uint16_t, 256> linear_of_byte_;  ///< sRGB byte -> linear, 65535 = 1
    std::vector<std::uint8_t> byte_of_linear_;       ///< and back, nearest
};

}  // namespace risorius::render
