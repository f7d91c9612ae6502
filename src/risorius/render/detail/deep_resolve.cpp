// SPDX-License-Identifier: MIT
#include "risorius/render/detail/deep_resolve.h"

#include <algorithm>
#include <cmath>

#include "risorius/core/srgb.h"
#include "risorius/render/detail/blend.h"

namespace risorius::render {

DeepResolve::DeepResolve(const Background& background) : transparent_(background.transparent) {
    for (std::size_t k = 0; k < 3; ++k)
        background_[k] = linear_of_srgb(std::clamp(background.rgb[k], 0.0, 1.0));
}

void DeepResolve::resolve(const std::vector<float>& samples, int supersampling, const Tile& tile,
                          Image& image) const {
    const auto n = static_cast<std::size_t>(supersampling);
    const auto width = static_cast<std::size_t>(tile.width);
    const std::size_t sample_row = width * n * 4;
    const auto count = static_cast<double>(n * n);
    for (int y = 0; y < tile.height; ++y) {
        const float* rows =
            samples.data() + static_cast<std::size_t>(tile.height - 1 - y) * n * sample_row;
        std::uint16_t* out =
            image.deep.data() + (image.pixel(tile.x, tile.y + y) - image.rgba.data());
        for (std::size_t x = 0; x < width; ++x, out += 4) {
            Vec3 sum = Vec3::Zero();
            double covered = 0;
            for (std::size_t j = 0; j < n; ++j) {
                const float* s = rows + j * sample_row + x * n * 4;
                for (std::size_t i = 0; i < n; ++i, s += 4) {
                    covered += s[3];
                    for (int k = 0; k < 3; ++k) sum[k] += s[k];
                }
            }
            if (!transparent_)
                for (std::size_t k = 0; k < 3; ++k)
                    sum[static_cast<Eigen::Index>(k)] += (count - covered) * background_[k];
            const double weight = transparent_ ? covered : count;
            const Vec3 srgb =
                weight > 0 ? srgb_of_linear((sum / weight).cwiseMin(1.0)) : Vec3(Vec3::Zero());
            std::uint8_t* byte = image.rgba.data() + (out - image.deep.data());
            for (int k = 0; k < 3; ++k)
                out[k] = static_cast<std::uint16_t>(std::lround(65535 * srgb[k]));
            out[3] = transparent_ ? static_cast<std::uint16_t>(std::lround(65535 * covered / count))
                                  : std::uint16_t{65535};
            for (int k = 0; k < 4; ++k) byte[k] = static_cast<std::uint8_t>((out[k] + 128U) / 257U);
        }
    }
}

}  // namespace risorius::render
