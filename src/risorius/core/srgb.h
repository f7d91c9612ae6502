// SPDX-License-Identifier: MIT
/// \file
/// The transfer function of sRGB (IEC 61966-2-1) between what is encoded and linear light, both 0..1.
#pragma once

#include <cmath>

namespace risorius {

inline double linear_of_srgb(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

inline double srgb_of_linear(double light) {
    return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

}  // namespace risorius
