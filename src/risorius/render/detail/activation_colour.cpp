// SPDX-License-Identifier: MIT
#include "risorius/render/detail/activation_colour.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "risorius/render/detail/cie_colour.h"

namespace risorius::render {
namespace {

// Ends of the ramp in CIE L*C*h (D65)
constexpr double kRestLightness = 24, kActiveLightness = 88;
constexpr double kRestHue_deg = 32, kActiveHue_deg = 90;
constexpr double kRestChroma = 34,
                 kMoreChroma = 42;  ///< more: added in the middle, for a strong orange

}  // namespace

Vec3 activation_colour(double activation) {
    const double a = std::clamp(activation, 0.0, 1.0);
    const double lightness = kRestLightness + a * (kActiveLightness - kRestLightness);
    const double hue_deg = kRestHue_deg + std::pow(a, 1.2) * (kActiveHue_deg - kRestHue_deg);
    const double chroma = kRestChroma + kMoreChroma * std::sin(0.62 * std::numbers::pi * a);
    return linear_of_lch(lightness, chroma, hue_deg);
}

}  // namespace risorius::render
