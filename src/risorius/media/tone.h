// SPDX-License-Identifier: MIT
/// \file
/// Changes luminance and contrast of pictures, and measures the luminance of many pictures together.
///
///   Y    relative luminance, see luminance.h
///
/// The linear light c of every channel becomes gain * c + offset, clamped to 0..1. So Y becomes gain * Y + offset, and hues are
/// kept. The result depends only on the bytes of the picture.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "risorius/core/image.h"

namespace risorius::media {

/// A linear change of light.
struct Tone {
    double gain = 1, offset = 0;  ///< of linear light, 1 is white

    bool changes() const { return gain != 1 || offset != 0; }
};

/// A tone as a table over the 256 values of a byte.
class ToneCurve {
  public:
    explicit ToneCurve(const Tone& tone);

    std::uint8_t of(std::uint8_t byte) const { return byte_[byte]; }
    void apply(Image& image) const;  ///< opacity does not change
    /// Fraction of channel values that are clipped at 0 or 1, over the pixels where the mask is not 0, or over all pixels
    /// without a mask.
    double cut_off(const Image& image, const std::vector<std::uint16_t>& mask = {}) const;

  private:
    std::array<std::uint8_t, 256> byte_{};
    std::array<bool, 256> is_cut_{};
};

/// Sums over the pixels of many pictures, weighted by opacity.
struct LuminanceSums {
    double weight = 0, sum = 0, squares = 0;

    /// Adds the pixels where the mask is not 0, or all pixels without a mask.
    void add(const Image& image, const std::vector<std::uint16_t>& mask = {});
    void add(const LuminanceSums& others);
    double mean() const { return weight > 0 ? sum / weight : 0; }
    double sd() const;
};

/// Returns the tone that gives pictures with these sums the given mean and standard deviation of Y, except for clipping.
Tone tone_between(const LuminanceSums& from, double mean, double sd);

}  // namespace risorius::media
