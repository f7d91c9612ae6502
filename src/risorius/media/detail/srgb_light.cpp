// SPDX-License-Identifier: MIT
#include "risorius/media/detail/srgb_light.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "risorius/core/srgb.h"

namespace risorius::media::detail {

namespace {

/// sRGB of linear light, 0..1.
double encoded(double light) { return std::clamp(srgb_of_linear(light), 0.0, 1.0); }

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

}  // namespace risorius::media::detail
