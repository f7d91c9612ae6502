// SPDX-License-Identifier: MIT
/// \file
/// Filters and noise for a soft region of a picture, in linear light.
///
///   w      weight of a pixel, 0 to 1; pixels of weight 0 keep their bytes
///   z      (c - mean of c) w, for the linear light c of each channel
///   f      radial frequency, cycles per pixel
///
/// Butterworth filter of order n: gain 1 / sqrt(1 + (f / fc)^(2n)) or, high-pass, 1 / sqrt(1 + (fc / f)^(2n)); -3 dB at fc, no phase.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "risorius/core/image.h"

namespace risorius::media {

struct PassFilter {
    bool high = false;               ///< high-pass, else low-pass
    double cut_cycles_per_px = 0.1;  ///< fc
    /// fc of a low-pass filter that follows; a high-pass filter becomes a band-pass filter with it
    std::optional<double> low_cut_cycles_per_px = {};
    int order = 4;         ///< n
    bool keep_sd = false;  ///< whether the standard deviation of luminance within w is restored
};

/// Filters an opaque picture.
void filter(const PassFilter& filter, const std::vector<float>& weights, Image& image);

/// Adds Gaussian noise of luminance. The picture keeps its standard deviation within w, except for clipping: with k = 1 / sqrt(1 + 10^(-snr/10)),
/// its contrast becomes k times what it was, and that of the noise k 10^(-snr/20) times. `snr_db`: power of the picture / power of the
/// noise, in dB.
void add_noise(double snr_db, unsigned seed, const std::vector<float>& weights, Image& image);

/// Mixes an opaque picture with a background of this sRGB colour by the weights.
void keep_weighted(const std::vector<float>& weights, const std::array<std::uint8_t, 3>& background,
                   Image& image);

}  // namespace risorius::media
