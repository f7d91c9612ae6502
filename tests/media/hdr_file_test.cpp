// SPDX-License-Identifier: MIT
// Light from Radiance files that are made here.
#include "risorius/media/hdr_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "message_of.h"

namespace risorius::media {
namespace {

namespace fs = std::filesystem;

fs::path written(const std::string& name, const std::string& bytes) {
    const fs::path file = fs::path(testing::TempDir()) / name;
    std::ofstream(file, std::ios::binary) << bytes;
    return file;
}

const std::string kHead = "#?RADIANCE\n# made by hand\nFORMAT=32-bit_rle_rgbe\n\n";

/// Ward's four bytes of a colour.
std::string rgbe(double r, double g, double b) {
    int exponent = 0;
    std::frexp(std::max({r, g, b}), &exponent);
    const double scale = std::ldexp(256.0, -exponent);
    std::string out;
    for (const double v : {r, g, b}) out += static_cast<char>(static_cast<int>(v * scale));
    return out + static_cast<char>(exponent + 128);
}

TEST(HdrFile, PlainPixelsComeBackWithinAPartIn256OverManyStops) {
    const double values[] = {1e-4, 0.03, 0.5, 1.0, 7.5, 30000.0};
    std::string bytes = kHead + "-Y 2 +X 3\n";
    for (const double v : values) bytes += rgbe(v, 0.5 * v, 0.25 * v);
    const HdrPicture picture = read_hdr(written("plain.hdr", bytes));
    ASSERT_EQ(picture.width, 3);
    ASSERT_EQ(picture.height, 2);
    for (std::size_t i = 0; i < 6; ++i) {
        const double step = values[i] / 128;
        EXPECT_NEAR(picture.rgb[3 * i], values[i], step);
        EXPECT_NEAR(picture.rgb[3 * i + 1], 0.5 * values[i], step);
        EXPECT_NEAR(picture.rgb[3 * i + 2], 0.25 * values[i], step);
    }
}

TEST(HdrFile, PackedRowsAreTheSameAsPlainOnes) {
    // Ten pixels, channel by channel: a run of six and four single bytes.
    std::string packed = kHead + "-Y 1 +X 10\n" + std::string("\x02\x02\x00\x0a", 4);
    std::string plain = kHead + "-Y 1 +X 10\n";
    const auto byte = [](int channel, int x) {
        return static_cast<char>(channel == 3 ? 129 : x < 6 ? 40 + channel : 100 + 7 * x + channel);
    };
    for (int channel = 0; channel < 4; ++channel) {
        packed += static_cast<char>(128 + 6);
        packed += byte(channel, 0);
        packed += static_cast<char>(4);
        for (int x = 6; x < 10; ++x) packed += byte(channel, x);
    }
    for (int x = 0; x < 10; ++x)
        for (int channel = 0; channel < 4; ++channel) plain += byte(channel, x);
    const HdrPicture a = read_hdr(written("packed.hdr", packed));
    EXPECT_EQ(a.rgb, read_hdr(written("even.hdr", plain)).rgb);
    EXPECT_EQ(a.rgb.size(), 30U);
    EXPECT_NEAR(a.rgb[0], 40.0 / 256 * 2, 1e-6);
}

TEST(HdrFile, OneThatWouldTakeMinutesIsRefused) {
    const fs::path large = written("large.hdr", kHead + "-Y 8192 +X 16384\n");
    EXPECT_EQ(
        risorius::message_of([&] { read_hdr(large); }),
        large.string() + ": expected at most as many pixels as 8192 x 4096, found 16384 x 8192");
}

TEST(HdrFile, AFileCutShortAndAnotherKindOfFileAreRefused) {
    const fs::path cut = written("cut.hdr", kHead + "-Y 2 +X 3\n" + rgbe(1, 1, 1));
    EXPECT_EQ(risorius::message_of([&] { read_hdr(cut); }),
              cut.string() + ": expected pixels of the whole picture, found the end of the file");
    const fs::path words = written("words.hdr", "not light\n");
    EXPECT_EQ(risorius::message_of([&] { read_hdr(words); }),
              words.string() + ": expected a Radiance .hdr file, found another one");
}

}  // namespace
}  // namespace risorius::media
