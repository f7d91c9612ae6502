// SPDX-License-Identifier: MIT
#include "risorius/media/luminance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "risorius/core/srgb.h"
#include "risorius/media/detail/srgb_light.h"

namespace risorius::media {

namespace {

// BT.709
constexpr std::array<double, 3> kFraction{0.2126, 0.7152, 0.0722};

using Table = std::array<double, 256>;

/// Contribution of a byte of each channel to the luminance.
const std::array<Table, 3>& luminance_of_byte() {
    static const std::array<Table, 3> tables = [] {
        std::array<Table, 3> out{};
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t i = 0; i < 256; ++i)
                out[k][i] = kFraction[k] * linear_of_srgb(static_cast<double>(i) / 255.0);
        return out;
    }();
    return tables;
}

const std::array<double, 256>& opacity_of_byte() {
    static const std::array<double, 256> table = [] {
        std::array<double, 256> out{};
        for (std::size_t i = 0; i < 256; ++i) out[i] = static_cast<double>(i) / 255.0;
        return out;
    }();
    return table;
}

}  // namespace

double relative_luminance(const std::uint8_t* rgb) {
    const std::array<Table, 3>& of = luminance_of_byte();
    return of[0][rgb[0]] + of[1][rgb[1]] + of[2][rgb[2]];
}

double light_of(const Image& image, std::size_t pixel, std::size_t channel) {
    const std::size_t at = 4 * pixel + channel;
    if (!image.deep.empty()) return detail::light_of_deep_srgb(image.deep[at]);
    return luminance_of_byte()[0][image.rgba[at]] / kFraction[0];
}

double relative_luminance(const Image& image, std::size_t pixel) {
    if (image.deep.empty()) return relative_luminance(&image.rgba[4 * pixel]);
    double y = 0;
    for (std::size_t k = 0; k < 3; ++k)
        y += kFraction[k] * detail::light_of_deep_srgb(image.deep[4 * pixel + k]);
    return y;
}

double opacity_of(const Image& image, std::size_t pixel) {
    return image.deep.empty() ? image.rgba[4 * pixel + 3] / 255.0
                              : image.deep[4 * pixel + 3] / 65535.0;
}

double mean_luminance(const Image& image, const std::vector<std::uint16_t>& mask) {
    double weight = 0, sum = 0;
    for (std::size_t i = 0; i < mask.size(); ++i) {
        if (mask[i] == 0) continue;
        const std::uint8_t* pixel = image.rgba.data() + 4 * i;
        weight += pixel[3] / 255.0;
        sum += pixel[3] / 255.0 * relative_luminance(pixel);
    }
    return weight > 0 ? sum / weight : std::numeric_limits<double>::quiet_NaN();
}

PictureMeasures LuminanceMeter::measure(const Image& image) {
    constexpr std::size_t kBlock_px = 64;
    const std::size_t pixels = image.rgba.size() / 4;
    const bool first = before_.size() != image.rgba.size();
    if (first) blocks_.assign((pixels + kBlock_px - 1) / kBlock_px, {});
    const std::array<Table, 3>& of = luminance_of_byte();
    const std::array<double, 256>& opacity_of = opacity_of_byte();
    const auto luminance_at = [&](const std::uint8_t* pixel) {
        return of[0][pixel[0]] + of[1][pixel[1]] + of[2][pixel[2]];
    };
    double weight = 0, sum = 0, squares = 0, change = 0;
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
        Block& block = blocks_[i];
        const std::size_t begin = 4 * kBlock_px * i,
                          end = std::min(begin + 4 * kBlock_px, image.rgba.size());
        const std::uint8_t *now = image.rgba.data(), *before = before_.data();
        // Most of a picture does not change: the background never, and the face only where it moves.
        if (first || std::memcmp(now + begin, before + begin, end - begin) != 0) {
            block = {};
            for (std::size_t k = begin; k < end; k += 4) {
                const double opacity = opacity_of[now[k + 3]], y = luminance_at(now + k);
                block.opacity += opacity;
                block.sum += opacity * y;
                block.squares += opacity * y * y;
                if (!first && std::memcmp(now + k, before + k, 4) != 0) {
                    const double difference =
                        opacity * y - opacity_of[before[k + 3]] * luminance_at(before + k);
                    change += difference * difference;
                }
            }
        }
        weight += block.opacity;
        sum += block.sum;
        squares += block.squares;
    }
    before_ = image.rgba;
    PictureMeasures out;
    if (weight == 0) return out;
    out.luminance_mean = sum / weight;
    out.luminance_sd =
        std::sqrt(std::max(0.0, squares / weight - out.luminance_mean * out.luminance_mean));
    out.contrast_rms = out.luminance_mean > 0 ? out.luminance_sd / out.luminance_mean : 0.0;
    out.motion_energy = change / static_cast<double>(pixels);
    return out;
}

}  // namespace risorius::media
