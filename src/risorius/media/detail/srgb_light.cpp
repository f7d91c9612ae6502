// SPDX-License-Identifier: MIT
#include "risorius/media/detail/srgb_light.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "risorius/core/srgb.h"

namespace risorius::media::detail {

namespace {

/// sRGB of linear light, 0..1.
double encoded(double light) { return std::clamp(srgb_of_linear(light), 0.0, 1.0); }

/// Linear light of all bytes.
const std::array<double, 256>& light_of_bytes() {
    static const std::array<double, 256> table = [] {
        std::array<double, 256> out{};
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = linear_of_srgb(static_cast<double>(i) / 255);
        return out;
    }();
    return table;
}

}  // namespace

double light_of_srgb(int byte) { return linear_of_srgb(byte / 255.0); }

double light_of_deep_srgb(std::uint16_t value) {
    static const std::vector<double> table = [] {
        std::vector<double> out;
        for (int i = 0; i < 65536; ++i) out.push_back(linear_of_srgb(i / 65535.0));
        return out;
    }();
    return table[value];
}

std::uint8_t srgb_of_light(double light) {
    return static_cast<std::uint8_t>(std::lround(255 * encoded(light)));
}

std::uint16_t deep_srgb_of_light(double light) {
    return static_cast<std::uint16_t>(std::lround(65535 * encoded(light)));
}

void set_srgb_of_lights(const std::array<double, 3>& light, std::uint8_t* rgb) {
    if (light[0] == light[1] && light[0] == light[2]) {
        std::fill_n(rgb, 3, srgb_of_light(light[0]));
        return;
    }
    const std::array<double, 256>& of = light_of_bytes();
    // What a byte adds to the error of luminance, and the square of its distance in steps
    struct Choice {
        std::uint8_t byte = 0;
        double too_bright = 0, off = 0;
    };
    std::array<std::array<Choice, 4>, 3> choices{};
    std::array<std::size_t, 3> count{};
    for (std::size_t k = 0; k < 3; ++k) {
        const double wanted = std::clamp(light[k], 0.0, 1.0), at = 255 * encoded(wanted),
                     wider = k == 2 ? 1 : 0;
        for (double near = std::max(std::floor(at) - wider, 0.0);
             near <= std::min(std::ceil(at) + wider, 255.0); ++near) {
            const auto byte = static_cast<std::uint8_t>(near);
            choices[k][count[k]++] = {byte, kLuma[k] * (of[byte] - wanted),
                                      (near - at) * (near - at)};
        }
    }
    std::pair best{1e9, 1e9};
    for (std::size_t r = 0; r < count[0]; ++r)
        for (std::size_t g = 0; g < count[1]; ++g)
            for (std::size_t b = 0; b < count[2]; ++b) {
                const Choice &red = choices[0][r], &green = choices[1][g], &blue = choices[2][b];
                const std::pair one{std::abs(red.too_bright + green.too_bright + blue.too_bright),
                                    red.off + green.off + blue.off};
                if (one >= best) continue;
                best = one;
                rgb[0] = red.byte;
                rgb[1] = green.byte;
                rgb[2] = blue.byte;
            }
}

}  // namespace risorius::media::detail
