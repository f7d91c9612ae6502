// SPDX-License-Identifier: MIT
/// \file
/// Reads pictures of common formats (PNG, JPEG, TGA, BMP, TIFF, WebP) through the FFmpeg libraries, as 8-bit sRGB.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "risorius/core/image.h"

namespace risorius::media {

/// Reads a picture. Throws Error that names the file when it is missing or not a picture.
Image read_picture(const std::filesystem::path& file);
/// Does the same with the bytes of a file, which messages call `name`.
Image read_picture(const std::vector<std::uint8_t>& bytes, const std::string& name);

}  // namespace risorius::media
