// SPDX-License-Identifier: MIT
/// \file
/// Floating-point pictures as OpenEXR files: 32 bits, lossless compression (ZIP), written by the FFmpeg libraries. A single
/// channel is named Y; three channels are named R, G and B.
#pragma once

#include <filesystem>
#include <vector>

namespace risorius::media {

/// A picture of floating-point samples.
struct FloatImage {
    int width_px = 0, height_px = 0;
    int channels = 1;            ///< 1 or 3
    std::vector<float> samples;  ///< height x width x channels, rows from the top
};

/// Writes a picture under a temporary name and then renames the file. Throws RunError on failure.
void write_exr(const FloatImage& image, const std::filesystem::path& file);
/// Reads a picture with one channel Y, or with R, G and B. Throws Error for other files.
FloatImage read_exr(const std::filesystem::path& file);

}  // namespace risorius::media
