// SPDX-License-Identifier: MIT
#include "risorius/media/detail/srgb_light.h"

#include <algorithm>
#include <cmath>

namespace risorius::media::detail {

double light_of_srgb(int byte) {
    const double v = byte / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

std::uint8_t srgb_of_light(double light) {
    const double v = light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(v, 0.0, 1.0)));
}

}  // namespace risorius::media::detail
