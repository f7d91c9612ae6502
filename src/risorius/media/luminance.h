// SPDX-License-Identifier: MIT
/// \file
/// Luminance statistics of pictures as stimuli: mean, contrast, and change since the previous picture.
///
///   Y    relative luminance of a pixel, 0 black .. 1 white: sRGB decoded to linear light (IEC 61966-2-1), BT.709 weights
///
/// The values are proportional to the luminance of a screen that shows the decoded values linearly. Pixels are weighted by
/// opacity.
#pragma once

#include <cstdint>
#include <vector>

#include "risorius/core/image.h"

namespace risorius::media {

/// The statistics of one picture.
struct PictureMeasures {
    double luminance_mean = 0;  ///< mean of Y
    double luminance_sd = 0;    ///< RMS contrast as defined by Peli 1990, J. Opt. Soc. Am. A 7(10)
    double contrast_rms = 0;    ///< luminance_sd / luminance_mean
    double motion_energy = 0;   ///< mean of (Y - Y of the previous picture)^2; 0 for the first
};

/// Measures the pictures of one video.
class LuminanceMeter {
  public:
    /// Pictures must be given in order and have the same size.
    PictureMeasures measure(const Image& image);

  private:
    /// Sums over a group of neighbouring pixels. They are reused while these pixels do not change.
    struct Block {
        double opacity = 0, sum = 0, squares = 0;
    };
    std::vector<std::uint8_t> before_;  ///< RGBA of the last picture
    std::vector<Block> blocks_;
};

/// Returns the mean of Y where the mask is not 0; NaN when it is 0 everywhere.
double mean_luminance(const Image& image, const std::vector<std::uint16_t>& mask);

/// Returns Y of an sRGB pixel.
double relative_luminance(const std::uint8_t* rgb);

/// Returns Y, the linear light of a channel, and the opacity of a pixel of a picture, 0..1: from its 16 bits where it has them.
double relative_luminance(const Image& image, std::size_t pixel);
double light_of(const Image& image, std::size_t pixel, std::size_t channel);
double opacity_of(const Image& image, std::size_t pixel);

}  // namespace risorius::media
