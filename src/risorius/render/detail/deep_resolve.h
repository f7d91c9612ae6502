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

    /// Like Resolve, for linear samples. Writes image.deep, and its nearest bytes into image.rgba.
    void resolve(const std::vector<float>& samples, int supersampling, const Tile& tile,
                 Image& image) const;

  private:
    bool transparent_;
    std::array<double, 3> background_;  ///< linear
};

}  // namespace risorius::render
