// SPDX-License-Identifier: MIT
#include "risorius/render/value_colour.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "risorius/render/detail/blend.h"
#include "risorius/render/detail/cie_colour.h"

namespace risorius::render {
namespace {

// CIE L*C*h of an unsigned quantity at 0 and 1
constexpr double kNoneLightness = 90, kMaxLightness = 20;
constexpr double kNoneHue_deg = 95, kMaxHue_deg = -50;
constexpr double kNoneChroma = 6, kMaxChroma = 46, kMoreChroma = 38;  ///< more: added in the middle

// CIE L*C*h of a signed quantity at -1, 0 and 1
constexpr double kBelowLightness = 16, kZeroLightness = 58, kAboveLightness = 92;
constexpr double kBelowHue_deg = 275, kAboveHue_deg = 88;
constexpr double kBelowChroma = 48, kAboveChroma = 68;

}  // namespace

Vec3 value_colour(double value, double from, double to) {
    const double v = std::clamp(value, std::min(from, to), std::max(from, to));
    if (from < 0 && to > 0) {
        const double s = v < 0 ? v / -from : v / to;
        return s < 0 ? linear_of_lch(kZeroLightness + s * (kZeroLightness - kBelowLightness),
                                     -s * kBelowChroma, kBelowHue_deg)
                     : linear_of_lch(kZeroLightness + s * (kAboveLightness - kZeroLightness),
                                     s * kAboveChroma, kAboveHue_deg);
    }
    const double s = to == from ? 0 : (v - from) / (to - from);
    return linear_of_lch(
        kNoneLightness + s * (kMaxLightness - kNoneLightness),
        kNoneChroma + s * (kMaxChroma - kNoneChroma) + kMoreChroma * std::sin(std::numbers::pi * s),
        kNoneHue_deg + s * (kMaxHue_deg - kNoneHue_deg));
}

Vec3 no_value_colour() { return linear_of_lch(62, 0, 0); }

Vec3 srgb_of(const Vec3& linear) { return srgb_of_linear(linear); }

}  // namespace risorius::render
