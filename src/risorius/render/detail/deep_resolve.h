// SPDX-License-Identifier: MIT
/// \file
/// Converts samples of linear light in 32-bit floats to pixels of 16 bits per channel, and those to 8 bits.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "risorius/core/image.h"
#include "risorius/render/detail/resolve.h"

namespace risorius::render {

class DeepResolve {
  public:
    explicit DeepResolve(const Background& background);

    /// Averages the samples of one tile as Resolve does. `samples`: RGBA in linear light, premultiplied by alpha, rows from the
    /// bottom, `supersampling` times as wide and high as the tile. Writes sRGB to image.deep, and the same rounded to bytes to
    /// image.rgba.
    void resolve(const std::vector<float>& samples, int supersampling, const Tile& tile,
                 Image& image) const;

  private:
    bool transparent_;
    std::array<double, 3> background_;  ///< linear
};

}  // namespace risorius::render
