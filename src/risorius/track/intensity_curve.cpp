// SPDX-License-Identifier: MIT
#include "risorius/track/intensity_curve.h"

#include <algorithm>

#include "risorius/track/detail/curve.h"

namespace risorius::track {

namespace {
constexpr double kPart = 0.25;
}

IntensityCurve::IntensityCurve(const std::array<double, 3>& activation) {
    std::copy(activation.begin(), activation.end(), at_.begin() + 1);
    identity_ = activation == std::array<double, 3>{0.25, 0.5, 0.75};
    std::array<double, 4> secant;
    for (std::size_t i = 0; i < 4; ++i) secant[i] = (at_[i + 1] - at_[i]) / kPart;
    slope_[0] = secant[0];
    slope_[4] = secant[3];
    for (std::size_t i = 1; i < 4; ++i) slope_[i] = (secant[i - 1] + secant[i]) / 2;
    keep_monotone(secant, slope_);
}

double IntensityCurve::activation(double intensity) const {
    if (identity_) return intensity;
    if (intensity < 0) return -activation(-intensity);
    if (intensity >= 1) return intensity;
    const auto i = static_cast<std::size_t>(intensity / kPart);
    const double s = intensity / kPart - static_cast<double>(i);
    return at_[i] + s * s * (3 - 2 * s) * (at_[i + 1] - at_[i]) +
           kPart * s * (1 - s) * ((1 - s) * slope_[i] - s * slope_[i + 1]);
}

}  // namespace risorius::track
