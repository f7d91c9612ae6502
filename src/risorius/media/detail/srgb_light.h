// SPDX-License-Identifier: MIT
/// \file
/// Values of sRGB with 8 and 16 bits and linear light, IEC 61966-2-1.
#pragma once

#include <array>
#include <cstdint>

namespace risorius::media::detail {

/// Weights of red, green and blue in relative luminance, BT.709
inline constexpr std::array kLuma{0.2126, 0.7152, 0.0722};

/// Linear light of a byte, 0..1.
double light_of_srgb(int byte);

/// Linear light of a value of 16 bits, 0..1.
double light_of_deep_srgb(std::uint16_t value);

/// The byte of a linear light, which is clamped to 0..1.
std::uint8_t srgb_of_light(double light);
/// The same with 16 bits.
std::uint16_t deep_srgb_of_light(double light);

/// Writes the three bytes of a pixel whose luminance is nearest to that of these linear lights, which are clamped to 0..1. Red and
/// green are the bytes below or above, blue is less than two steps away: a step of blue is a tenth of one of green, and hardly
/// seen. A grey has three equal bytes. `rgb` may be a pixel of a picture with opacity.
void set_srgb_of_lights(const std::array<double, 3>& light, std::uint8_t* rgb);

}  // namespace risorius::media::detail
