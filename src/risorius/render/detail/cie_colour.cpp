// SPDX-License-Identifier: MIT
#include "risorius/render/detail/cie_colour.h"

#include <cmath>
#include <numbers>

namespace risorius::render {
namespace {

double uncompressed(double f) {
    constexpr double kKnee = 6.0 / 29.0;
    return f > kKnee ? f * f * f : 3 * kKnee * kKnee * (f - 4.0 / 29.0);
}

}  // namespace

Vec3 linear_of_lch(double lightness, double chroma, double hue_deg) {
    const double hue = hue_deg * std::numbers::pi / 180;
    const double fy = (lightness + 16) / 116;
    const Vec3 xyz(0.95047 * uncompressed(fy + chroma * std::cos(hue) / 500), uncompressed(fy),
                   1.08883 * uncompressed(fy - chroma * std::sin(hue) / 200));
    Mat3 rgb_of_xyz;  // IEC 61966-2-1
    rgb_of_xyz << 3.2406, -1.5372, -0.4986, -0.9689, 1.8758, 0.0415, 0.0557, -0.2040, 1.0570;
    return (rgb_of_xyz * xyz).cwiseMax(0.0).cwiseMin(1.0);
}

}  // namespace risorius::render
