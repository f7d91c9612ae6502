// Pictures of light (Radiance .hdr, RGBE): more than white, as surroundings are photographed.
//
// Source: Ward 1991, Real Pixels (Graphics Gems II), and the file format of Radiance.
#pragma once

#include <filesystem>
#include <vector>

namespace risorius::media {

struct HdrPicture {
    int width = 0, height = 0;
    std::vector<float> rgb;  ///< 3 per pixel, rows from the top, linear
};

/// Throws Error for what is no .hdr of RGBE pixels in rows from the top left, or ends before its last row.
HdrPicture read_hdr(const std::filesystem::path& file);

}  // namespace risorius::media
