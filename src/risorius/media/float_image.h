// SPDX-License-Identifier: MIT
/// \file
/// Floating-point pictures: OpenEXR files, 32 bits, compressed without loss (ZIP), written by the FFmpeg libraries. One channel is named Y,
/// three are named R, G and B.
#pragma once

#include <filesystem>
#include <vector>

namespace risorius::media {

struct FloatImage {
    int width_px = 0, height_px = 0;
    int channels = 1;            ///< 1 or 3
    std::vector<float> samples;  ///< height x width x channels, rows from the top
};

/// Written under another name first and then renamed. Throws RunError on failure.
void write_exr(const FloatImage& image, const std::filesystem::path& file);
/// Reads files of these two kinds only.
FloatImage read_exr(const std::filesystem::path& file);

}  // namespace risorius::media
