// From samples of 8 bits to pixels of 16: the mean of N x N of them in linear light has some 2 log2 N bits more.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/image.h"
#include "render/detail/resolve.h"

namespace risorius::render {

class DeepResolve {
  public:
    explicit DeepResolve(const Background& background);

    /// As Resolve, into image.deep.
    void resolve(const std::vector<std::uint8_t>& samples, int supersampling, const Tile& tile,
                 Image& image) const;

  private:
    bool transparent_;
    std::array<double, 3> background_;        ///< linear
    std::array<double, 256> linear_of_byte_;  ///< sRGB
};

}  // namespace risorius::render
