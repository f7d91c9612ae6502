// SPDX-License-Identifier: MIT
#include "risorius/media/face_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "risorius/media/luminance.h"
#include "risorius/media/tone.h"

namespace risorius::media {
namespace {

constexpr int kFilterSide = 128;
const std::vector<float> kWhole(kFilterSide* kFilterSide, 1.0F);

/// A grating of so many cycles per picture, in linear light.
Image grating(int cycles) {
    Image image(kFilterSide, kFilterSide);
    for (int y = 0; y < kFilterSide; ++y)
        for (int x = 0; x < kFilterSide; ++x) {
            const double light =
                0.3 + 0.2 * std::cos(2 * 3.14159265358979 * cycles * x / kFilterSide);
            for (int k = 0; k < 4; ++k)
                image.pixel(x, y)[k] = static_cast<std::uint8_t>(
                    k == 3 ? 255 : std::lround(255 * (1.055 * std::pow(light, 1 / 2.4) - 0.055)));
        }
    return image;
}

double amplitude_of(const Image& image, int cycles) {
    std::complex<double> sum = 0;
    for (int x = 0; x < kFilterSide; ++x)
        sum += std::polar(relative_luminance(image.pixel(x, 5)),
                          -2 * 3.14159265358979 * cycles * x / kFilterSide);
    return std::abs(sum);
}

double gain_db(const PassFilter& pass, int cycles) {
    Image image = grating(cycles);
    const double before = amplitude_of(image, cycles);
    filter(pass, kWhole, image);
    return 20 * std::log10(amplitude_of(image, cycles) / before);
}

TEST(FaceFilter, IsThreeDecibelsDownWhereItCutsAndTwentyFourAnOctaveOff) {
    const PassFilter low{.cut_cycles_per_px = 8.0 / kFilterSide},
        high{.high = true, .cut_cycles_per_px = 16.0 / kFilterSide};
    EXPECT_NEAR(gain_db(low, 8), -3, 0.2);
    EXPECT_NEAR(gain_db(low, 16), -24, 1);
    EXPECT_NEAR(gain_db(low, 2), 0, 0.1);
    EXPECT_NEAR(gain_db(high, 16), -3, 0.2);
    EXPECT_NEAR(gain_db(high, 8), -24, 1);
    EXPECT_NEAR(gain_db(high, 50), 0, 0.1);
}

TEST(FaceFilter, OfABandPassesOnlyWhatIsWithin) {
    const PassFilter band{.high = true,
                          .cut_cycles_per_px = 8.0 / kFilterSide,
                          .low_cut_cycles_per_px = 24.0 / kFilterSide};
    EXPECT_NEAR(gain_db(band, 8), -3, 0.2);
    EXPECT_NEAR(gain_db(band, 24), -3, 0.2);
    EXPECT_NEAR(gain_db(band, 14), 0, 0.1);
    EXPECT_NEAR(gain_db(band, 4), -24, 1);
    EXPECT_NEAR(gain_db(band, 48), -24, 1);
}

TEST(FaceFilter, RestoresTheDeviationOnRequest) {
    Image image = grating(8);
    LuminanceSums before, after;
    before.add(image, kWhole);
    filter({.cut_cycles_per_px = 8.0 / kFilterSide, .keep_sd = true}, kWhole, image);
    after.add(image, kWhole);
    EXPECT_NEAR(after.sd(), before.sd(), 0.002);
}

TEST(FaceFilter, NoiseHasItsPowerAndThePictureKeepsItsDeviation) {
    const Image source = grating(4);
    for (const double snr_db : {12.0, 3.0}) {
        Image image = source, other = source;
        add_noise(snr_db, 1, kWhole, image);
        add_noise(snr_db, 2, kWhole, other);
        EXPECT_NE(image.rgba, other.rgba);
        const double kept = 1 / std::sqrt(1 + std::pow(10, -snr_db / 10));
        EXPECT_NEAR(amplitude_of(image, 4) / amplitude_of(source, 4), kept, 0.05);
        LuminanceSums before, after;
        before.add(source, kWhole);
        after.add(image, kWhole);
        EXPECT_NEAR(after.sd(), before.sd(), 0.03 * before.sd());
        double noise = 0, signal = 0;
        for (std::size_t i = 0; i < kWhole.size(); ++i) {
            const double y = relative_luminance(&source.rgba[4 * i]) - before.mean();
            signal += kept * kept * y * y;
            noise += std::pow(relative_luminance(&image.rgba[4 * i]) - before.mean() - kept * y, 2);
        }
        EXPECT_NEAR(10 * std::log10(signal / noise), snr_db, 0.4) << "some values are cut off";
    }
}

TEST(FaceFilter, LeavesWhatHasNoWeight) {
    std::vector<float> weights = kWhole;
    for (std::size_t i = 0; i < weights.size() / 2; ++i) weights[i] = 0;
    const Image source = grating(20);
    Image low = source, noisy = source, oval = source;
    filter({.cut_cycles_per_px = 0.05}, weights, low);
    add_noise(0, 1, weights, noisy);
    keep_weighted(weights, {10, 20, 30}, oval);
    for (std::size_t i = 0; i < 2 * weights.size(); ++i) {
        ASSERT_EQ(low.rgba[i], source.rgba[i]);
        ASSERT_EQ(noisy.rgba[i], source.rgba[i]);
    }
    EXPECT_EQ(oval.pixel(3, 3)[1], 20);
    EXPECT_EQ(oval.pixel(3, 100)[1], source.pixel(3, 100)[1]);
}

}  // namespace
}  // namespace risorius::media
