// SPDX-License-Identifier: MIT
#include "risorius/media/tone.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>

#include "risorius/media/luminance.h"

namespace risorius::media {
namespace {

/// Every grey once, and some colours.
Image ramp() {
    Image image(256, 2);
    for (int x = 0; x < 256; ++x)
        for (int y = 0; y < 2; ++y) {
            std::uint8_t* pixel = image.pixel(x, y);
            pixel[0] = static_cast<std::uint8_t>(x);
            pixel[1] = static_cast<std::uint8_t>(y == 0 ? x : 255 - x);
            pixel[2] = static_cast<std::uint8_t>(x);
            pixel[3] = 255;
        }
    return image;
}

TEST(Tone, WithoutChangeIsThePictureItself) {
    Image image = ramp();
    ToneCurve({}).apply(image);
    EXPECT_EQ(image.rgba, ramp().rgba);
    EXPECT_EQ(ToneCurve({}).cut_off(image), 0);
}

TEST(Tone, GivesPicturesTheMeanAndDeviationAskedFor) {
    Image image = ramp();
    LuminanceSums before;
    before.add(image);
    const Tone tone = tone_between(before, 0.4, 0.1);
    ToneCurve curve(tone);
    EXPECT_EQ(curve.cut_off(image), 0);
    curve.apply(image);
    LuminanceSums after;
    after.add(image);
    // A byte has an error of at most half a step of 1/255, which is 0.004 of Y where the curve is steepest. The errors are
    // random.
    EXPECT_NEAR(after.mean(), 0.4, 5e-4);
    EXPECT_NEAR(after.sd(), 0.1, 5e-4);
}

// A dark face needs a gain of 3 to 6: from bytes, most of the values in between are never shown.
TEST(Tone, OfSixteenBitsFillsTheStepsBetweenBytes) {
    Image deep(2560, 1);
    for (int x = 0; x < 2560; ++x) {
        const auto value = static_cast<std::uint16_t>(7000 + 2 * x);
        for (int k = 0; k < 3; ++k) {
            deep.deep.push_back(value);
            deep.pixel(x, 0)[k] = static_cast<std::uint8_t>((value + 128U) / 257U);
        }
        deep.deep.push_back(65535);
        deep.pixel(x, 0)[3] = 255;
    }
    Image bytes = deep;
    bytes.deep.clear();
    LuminanceSums before;
    before.add(deep);
    const Tone tone = tone_between(before, 0.3, 0.06);
    EXPECT_GT(tone.gain, 5);
    const auto levels = [&](Image image) {
        ToneCurve(tone).apply_over({128, 128, 128}, image);
        EXPECT_TRUE(image.deep.empty());
        std::set<int> out;
        for (int x = 0; x < image.width_px; ++x) out.insert(image.pixel(x, 0)[1]);
        return std::pair{out.size(), *out.rbegin() - *out.begin() + 1};
    };
    EXPECT_EQ(static_cast<int>(levels(deep).first), levels(deep).second) << "no step is left out";
    EXPECT_LT(static_cast<int>(levels(bytes).first), levels(bytes).second / 2);
    LuminanceSums after;
    ToneCurve(tone).apply(deep);
    after.add(deep);
    EXPECT_NEAR(after.mean(), 0.3, 1e-4);
    EXPECT_NEAR(after.sd(), 0.06, 1e-4);
}

// Bytes of three channels have many more luminances than a grey. Each channel rounded by itself is wrong by 8e-4 here.
TEST(Tone, OfSixteenBitsRoundsToTheNearestLuminance) {
    constexpr int kPixels = 4000;
    Image image(kPixels, 1);
    for (int x = 0; x < kPixels; ++x) {
        // A skin from dark to bright
        const double bright = 0.2 + 0.7 * x / kPixels;
        for (const double k : {1.0, 0.8, 0.7})
            image.deep.push_back(static_cast<std::uint16_t>(std::lround(65535 * k * bright)));
        image.deep.push_back(65535);
    }
    const Image deep = image;
    ToneCurve({}).apply_over({128, 128, 128}, image);
    double squares = 0;
    for (std::size_t x = 0; x < kPixels; ++x) {
        squares += std::pow(relative_luminance(image, x) - relative_luminance(deep, x), 2);
        for (std::size_t k = 0; k < 3; ++k) {
            const double away =
                std::abs(image.rgba[4 * x + k] - static_cast<double>(deep.deep[4 * x + k]) / 257);
            ASSERT_LT(away, k == 2 ? 2 : 1) << x << " " << k;
        }
    }
    EXPECT_LT(std::sqrt(squares / kPixels), 2.5e-4);
}

TEST(Tone, OfSixteenBitsLeavesGreyGrey) {
    Image image(1000, 1);
    for (int x = 0; x < 1000; ++x) {
        image.deep.insert(image.deep.end(), 3, static_cast<std::uint16_t>(65 * x));
        image.deep.push_back(65535);
    }
    ToneCurve({}).apply_over({128, 128, 128}, image);
    for (int x = 0; x < 1000; ++x) {
        const std::uint8_t* pixel = image.pixel(x, 0);
        ASSERT_TRUE(pixel[0] == pixel[1] && pixel[0] == pixel[2]) << x;
    }
}

TEST(Tone, TellsHowMuchItCutsOff) {
    const Image image = ramp();
    // With doubled light, everything above half is clipped: bytes above 187.
    const ToneCurve curve(Tone{.gain = 2, .offset = 0});
    EXPECT_EQ(curve.of(188), 255);
    EXPECT_LT(curve.of(187), 255);
    EXPECT_NEAR(curve.cut_off(image), 68.0 / 256, 1e-12);
    std::vector<std::uint16_t> mask(512, 0);
    mask[10] = 1;
    EXPECT_EQ(curve.cut_off(image, mask), 0);
}

TEST(LuminanceSums, AreThoseOfTheMeterAndOfTheirParts) {
    const Image image = ramp();
    LuminanceSums all, left, right;
    all.add(image);
    std::vector<std::uint16_t> mask(512, 0);
    for (std::size_t i = 0; i < 100; ++i) mask[i] = 1;
    left.add(image, mask);
    for (std::uint16_t& one : mask) one = one ? 0 : 1;
    right.add(image, mask);
    left.add(right);
    EXPECT_NEAR(left.mean(), all.mean(), 1e-14);
    EXPECT_NEAR(left.sd(), all.sd(), 1e-14);
    LuminanceMeter meter;
    const PictureMeasures measured = meter.measure(image);
    EXPECT_NEAR(all.mean(), measured.luminance_mean, 1e-12);
    EXPECT_NEAR(all.sd(), measured.luminance_sd, 1e-12);
}

TEST(LuminanceSums, CountPixelsByTheirOpacity) {
    Image image(2, 1);
    for (int k = 0; k < 4; ++k) image.pixel(0, 0)[k] = 255;
    LuminanceSums sums;
    sums.add(image);
    EXPECT_EQ(sums.mean(), 1);
    EXPECT_EQ(sums.sd(), 0);
}

}  // namespace
}  // namespace risorius::media
