// SPDX-License-Identifier: MIT
/// \file
/// Writes PNG files as raw samples without colour conversion: grey, colour, or colour with alpha; 8 or 16 bits.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace risorius::media::detail {

struct PngSamples {
    int width_px = 0, height_px = 0;
    int channels = 1;   ///< 1 grey, 3 colour, 4 colour and alpha
    int bits = 8;       ///< 8 or 16
    bool srgb = false;  ///< the samples are sRGB-encoded colour, and the file says so
    std::vector<std::uint16_t> samples;  ///< height x width x channels, rows from the top
};

/// Throws RunError when the file cannot be written.
void write_png_samples(const PngSamples& picture, const std::filesystem::path& file);

}  // namespace risorius::media::detail
