// SPDX-License-Identifier: MIT
/// \file
/// Reads and writes picture files with libpng: PNG with or without alpha.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "risorius/core/image.h"

namespace risorius::media {

/// Of a picture that is read: 400 MB, and up to three times as much while some formats are decoded.
inline constexpr std::int64_t kMostPixels = 100'000'000;
inline constexpr const char* kFewerPixels = "at most 100 million pixels";

/// How hard the pixels are compressed: quickly, or to about four fifths of that size in three times the time.
enum class PngSize { kFast, kSmall };
/// Returns the bytes of a PNG file. Alpha is kept when any pixel is not opaque. `name`: of the picture, for messages.
std::string png_bytes(const Image& image, const std::string& name, PngSize size = PngSize::kSmall);
/// Writes a picture under a temporary name and then renames the file. Alpha is kept when any pixel is not opaque. Throws RunError
/// on failure.
void write_png(const Image& image, const std::filesystem::path& file);
/// Does the same with 16 bits per channel: the picture's 16-bit pixels, or its 8-bit pixels expanded to 16 bits.
void write_png16(const Image& image, const std::filesystem::path& file);
/// Writes numbers instead of colours: one channel, 8 or 16 bits, rows from the top.
void write_grey_png(int width_px, int height_px, int bits,
                    const std::vector<std::uint16_t>& samples, const std::filesystem::path& file);
/// Returns whether any pixel is not opaque.
bool has_transparency(const Image& image);
/// Reads a picture. Throws Error when the file is missing, incomplete, too large, or not a PNG file with 8 bits per
/// channel.
Image read_png(const std::filesystem::path& file);

/// Writes ASCII text for captions. Its baseline begins at x, y, and capitals are `height_px` high.
void put_text(Image& image, const std::string& text, int x, int y, int height_px);

}  // namespace risorius::media
