// SPDX-License-Identifier: MIT
/// \file
/// Changes luminance and contrast of pictures, and measures the luminance of many pictures together.
///
///   Y    relative luminance, see luminance.h
///
/// The linear light c of every channel becomes gain * c + offset, clamped to 0..1. So Y becomes gain * Y + offset, and hues are
/// kept. The result depends only on the bytes of the picture.
///
/// Pictures with 16 bits (Image::deep) are measured and mapped by them, and only the result is rounded to bytes: to those near it
/// whose luminance is nearest. A mean, a deviation or a histogram then survives the rounding.
///
/// A picture with a transparent background is measured by weights: those of its pixels, times opacity. Its background is never
/// mapped.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "risorius/core/image.h"

namespace risorius::media {

/// A linear change of light.
struct Tone {
    double gain = 1, offset = 0;  ///< of linear light, 1 is white

    bool changes() const { return gain != 1 || offset != 0; }
};

/// A tone, with a table over the 256 values of a byte. Mapped pictures have bytes only.
class ToneCurve {
  public:
    explicit ToneCurve(const Tone& tone);

    std::uint8_t of(std::uint8_t byte) const { return byte_[byte]; }
    void apply(Image& image) const;  ///< opacity does not change
    /// Does the same, and puts the result over a background of this sRGB colour, in linear light.
    void apply_over(const std::array<std::uint8_t, 3>& background, Image& image) const;
    /// Fraction of channel values that are clipped at 0 or 1, over the pixels where the mask is not 0, or over all pixels
    /// without a mask.
    double cut_off(const Image& image, const std::vector<std::uint16_t>& mask = {}) const;
    /// The same with a weight per pixel.
    double cut_off(const Image& image, const std::vector<float>& weights) const;

  private:
    double light_after(const Image& image, std::size_t pixel, std::size_t channel) const;
    bool is_cut(const Image& image, std::size_t pixel, std::size_t channel) const;

    Tone tone_;
    std::array<std::uint8_t, 256> byte_{};
    std::array<bool, 256> is_cut_{};
    std::array<double, 256> light_{};
};

/// Sums over the pixels of many pictures, weighted by opacity.
struct LuminanceSums {
    double weight = 0, sum = 0, squares = 0;

    /// Adds the pixels where the mask is not 0, or all pixels without a mask.
    void add(const Image& image, const std::vector<std::uint16_t>& mask = {});
    /// Adds all pixels with these weights; opacity does not count.
    void add(const Image& image, const std::vector<float>& weights);
    void add(const LuminanceSums& others);
    double mean() const { return weight > 0 ? sum / weight : 0; }
    double sd() const;
};

/// Returns the tone that gives pictures with these sums the given mean and standard deviation of Y, except for clipping.
Tone tone_between(const LuminanceSums& from, double mean, double sd);

/// The colours of many pictures, in cells of 8 x 8 x 8 values of sRGB: what is needed to know how a tone clips them.
class ColourSums {
  public:
    void add(const Image& image, const std::vector<float>& weights);
    void add(const ColourSums& others);

    /// Mean and standard deviation of Y after a tone, and the fraction of channel values that it clips.
    struct Spread {
        double mean = 0, sd = 0, cut = 0;
    };
    Spread after(const Tone& tone) const;

    std::string text() const;  ///< for files
    /// Throws std::invalid_argument for any other text.
    static ColourSums of_text(const std::string& text);

  private:
    struct Cell {
        double weight = 0;
        std::array<double, 3> light{};  ///< sum of linear light
        double squares = 0;             ///< sum of squared Y
    };
    std::map<int, Cell> cells_;
};

/// A tone, and what it does to the colours that it was found for.
struct FittedTone {
    Tone tone;
    ColourSums::Spread spread;
};

/// Returns the tone after which the clipped values have this mean and standard deviation, to 1e-4 or as near as 60 steps come.
FittedTone fitted_tone(const ColourSums& colours, double mean, double sd);

}  // namespace risorius::media
