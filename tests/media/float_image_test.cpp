// SPDX-License-Identifier: MIT
// Pictures of numbers are written and read back bit for bit.
#include "risorius/media/float_image.h"

#include <gtest/gtest.h>

#include <limits>

#include "risorius/core/error.h"
#include "temporary_folder.h"

namespace risorius::media {
namespace {

TEST(FloatImage, ReadsBackBitForBit) {
    const TemporaryFolder folder;
    for (const int channels : {1, 3}) {
        FloatImage image{19, 37, channels, {}};
        for (int i = 0; i < 19 * 37 * channels; ++i)
            image.samples.push_back(static_cast<float>(i) * 0.3217f - 50.0f);
        image.samples[5] = std::numeric_limits<float>::infinity();
        image.samples[7] = 1e-30f;
        write_exr(image, folder / "a.exr");
        const FloatImage back = read_exr(folder / "a.exr");
        EXPECT_EQ(back.width_px, 19);
        EXPECT_EQ(back.height_px, 37);
        EXPECT_EQ(back.channels, channels);
        EXPECT_EQ(back.samples, image.samples);
    }
    EXPECT_EQ(folder.listing(), std::set<std::string>{"a.exr"});
    // The magic number of OpenEXR, and the names of its channels in alphabetical order.
    const std::string bytes = bytes_of(folder / "a.exr");
    EXPECT_EQ(bytes.substr(0, 4), "\x76\x2f\x31\x01");
    EXPECT_LT(bytes.find(std::string("B\0", 2)), bytes.find(std::string("R\0", 2)));
}

TEST(FloatImage, OfAnotherKindIsRefused) {
    const TemporaryFolder folder;
    std::ofstream(folder / "a.exr") << "no picture";
    try {
        read_exr(folder / "a.exr");
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(
            std::string(error.what()),
            (folder / "a.exr").string() +
                ": expected an OpenEXR picture, found another kind of file, or one cut short");
    }
}

}  // namespace
}  // namespace risorius::media
