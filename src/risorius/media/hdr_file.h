// SPDX-License-Identifier: MIT
/// \file
/// High dynamic range pictures (Radiance .hdr, RGBE), as used for photographed surroundings.
///
/// Sources: Ward 1991, Real Pixels (Graphics Gems II), and the file format of Radiance.
#pragma once

#include <filesystem>
#include <vector>

namespace risorius::media {

/// A picture of linear light.
struct HdrPicture {
    int width = 0, height = 0;
    std::vector<float> rgb;  ///< 3 per pixel, rows from the top, linear
};

/// Reads a file. Throws Error unless it is an .hdr with RGBE pixels, in rows from the top left, and complete to its last row.
HdrPicture read_hdr(const std::filesystem::path& file);

}  // namespace risorius::media
