// SPDX-License-Identifier: MIT
// JPEG pictures read back as what was written, within the error of their quantizer.
#include "risorius/media/jpeg_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "risorius/core/error.h"
#include "risorius/media/image_file.h"
#include "risorius/media/picture_file.h"

namespace risorius::media {
namespace {

/// Smooth colours with fine noise, as skin has.
Image mottled(int side) {
    Image out(side, side);
    unsigned noise = 1;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            noise = noise * 1664525u + 1013904223u;
            const double grain = 6 * (static_cast<double>(noise >> 8) / (1 << 24) - 0.5);
            std::uint8_t* const at = out.pixel(x, y);
            at[0] = static_cast<std::uint8_t>(190 + 30 * std::sin(0.05 * x) + grain);
            at[1] = static_cast<std::uint8_t>(140 + 25 * std::cos(0.04 * y) + grain);
            at[2] = static_cast<std::uint8_t>(115 + 20 * std::sin(0.03 * (x + y)) + grain);
            at[3] = 255;
        }
    return out;
}

double psnr_db(const Image& one, const std::string& bytes) {
    const Image other = read_picture(std::vector<std::uint8_t>(bytes.begin(), bytes.end()), "jpeg");
    EXPECT_EQ(other.width_px, one.width_px);
    EXPECT_EQ(other.height_px, one.height_px);
    double squares = 0;
    long count = 0;
    for (std::size_t i = 0; i < one.rgba.size(); ++i)
        if (i % 4 < 3) {
            const double off = one.rgba[i] - other.rgba.at(i);
            squares += off * off;
            ++count;
        }
    return 10 * std::log10(255.0 * 255.0 * static_cast<double>(count) / squares);
}

TEST(JpegFile, ReadsBackWithinItsErrorAndIsSmallerThanPng) {
    const Image image = mottled(200);
    const std::string fine = jpeg_bytes(image, "skin"), coarse = jpeg_bytes(image, "skin", 12);
    EXPECT_EQ(fine.substr(0, 3), "\xff\xd8\xff");
    EXPECT_GT(psnr_db(image, fine), 40);
    EXPECT_LT(psnr_db(image, coarse), psnr_db(image, fine) - 3);
    EXPECT_LT(coarse.size(), fine.size());
    EXPECT_LT(2 * fine.size(), png_bytes(image, "skin").size());
    EXPECT_EQ(fine, jpeg_bytes(image, "skin"));
    EXPECT_EQ(fine.find("Lavc"), std::string::npos);  // no version of a library
}

// Godot 3 refuses other sampling factors than these.
TEST(JpegFile, HasTheUsualSamplingFactors) {
    const std::string bytes = jpeg_bytes(mottled(64), "skin");
    const std::size_t frame = bytes.find("\xff\xc0");
    ASSERT_NE(frame, std::string::npos);
    EXPECT_EQ(bytes[frame + 9], 3);  // components: an identifier, the factors, a table each
    EXPECT_EQ(bytes[frame + 11], '\x22');
    EXPECT_EQ(bytes[frame + 14], '\x11');
    EXPECT_EQ(bytes[frame + 17], '\x11');
}

TEST(JpegFile, TakesAnySizeButNone) {
    const Image image = mottled(17);
    EXPECT_GT(psnr_db(image, jpeg_bytes(image, "odd")), 35);
    EXPECT_THROW(jpeg_bytes(Image(), "nothing"), Error);
}

}  // namespace
}  // namespace risorius::media
