// SPDX-License-Identifier: MIT
#include "risorius/media/phase_scramble.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdlib>

#include "risorius/media/tone.h"

namespace risorius::media {
namespace {

constexpr int kWaveWidth = 24, kWaveHeight = 18;

const std::vector<float> kEverywhere(kWaveWidth* kWaveHeight, 1.0F);

/// Soft waves of little contrast, so that nothing is clipped.
Image waves(double shift) {
    Image image(kWaveWidth, kWaveHeight);
    for (int y = 0; y < kWaveHeight; ++y)
        for (int x = 0; x < kWaveWidth; ++x) {
            const double u = 2 * 3.14159265358979 * (x + shift) / kWaveWidth,
                         v = 2 * 3.14159265358979 * y / kWaveHeight;
            const double value = 128 + 20 * std::cos(3 * u + v) + 12 * std::sin(2 * v);
            for (int k = 0; k < 3; ++k)
                image.pixel(x, y)[k] = static_cast<std::uint8_t>(std::lround(value + 10 * k));
            image.pixel(x, y)[3] = 200;
        }
    return image;
}

/// Amplitude of one frequency of the red channel, by its definition.
double amplitude(const Image& image, int fx, int fy) {
    std::complex<double> sum = 0;
    for (int y = 0; y < kWaveHeight; ++y)
        for (int x = 0; x < kWaveWidth; ++x)
            sum += std::polar<double>(std::pow(image.pixel(x, y)[0] / 255.0, 2.2),
                                      -2 * 3.14159265358979 *
                                          (static_cast<double>(fx * x) / kWaveWidth +
                                           static_cast<double>(fy * y) / kWaveHeight));
    return std::abs(sum) / (kWaveWidth * kWaveHeight);
}

TEST(PhaseScramble, KeepsTheAmplitudeOfEveryFrequencyAndNothingElse) {
    PhaseScrambler scrambler(kWaveWidth, kWaveHeight, 7);
    const Image before = waves(0);
    Image after = before;
    scrambler.scramble(after, kEverywhere);
    for (const auto& [fx, fy] : {std::pair{0, 0}, {3, 1}, {0, 2}, {5, 5}, {1, 0}})
        EXPECT_NEAR(amplitude(after, fx, fy), amplitude(before, fx, fy), 2e-3) << fx << " " << fy;
    long changed = 0;
    for (std::size_t i = 0; i < before.rgba.size(); i += 4)
        changed += std::abs(before.rgba[i] - after.rgba[i]) > 4;
    EXPECT_GT(changed, kWaveWidth * kWaveHeight / 2);
    EXPECT_EQ(after.pixel(3, 3)[3], 200);
    EXPECT_NEAR(after.pixel(5, 5)[2] - after.pixel(5, 5)[0], 20, 3);
    EXPECT_LT(scrambler.octave_error(), 0.01);
}

TEST(PhaseScramble, IsTheSameForTheSameSeedAndLetsStillPicturesStandStill) {
    PhaseScrambler one(kWaveWidth, kWaveHeight, 7), again(kWaveWidth, kWaveHeight, 7),
        other(kWaveWidth, kWaveHeight, 8);
    Image a = waves(0), b = waves(0), c = waves(0), moved = waves(1);
    one.scramble(a, kEverywhere);
    again.scramble(b, kEverywhere);
    other.scramble(c, kEverywhere);
    one.scramble(moved, kEverywhere);
    EXPECT_EQ(a.rgba, b.rgba);
    EXPECT_NE(a.rgba, c.rgba);
    EXPECT_NE(a.rgba, moved.rgba);
}

TEST(PhaseScramble, KeepsWhatIsOutsideOfARegionAndTheLevelInside) {
    constexpr int kSide = 64;
    Image before(kSide, kSide);
    std::vector<float> weights(kSide * kSide, 0);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const double away = std::hypot(x - 32, y - 32);
            weights[static_cast<std::size_t>(y * kSide + x)] =
                static_cast<float>(away < 20   ? 1
                                   : away < 26 ? 0.5 * (1 + std::cos(3.14159265 * (away - 20) / 6))
                                               : 0);
            for (int k = 0; k < 4; ++k)
                before.pixel(x, y)[k] = static_cast<std::uint8_t>(
                    k == 3 ? 255 : 110 + 30 * ((x / 5 + y / 7) % 2) + (x * x + 3 * y) % 17);
        }
    Image after = before;
    PhaseScrambler scrambler(kSide, kSide, 3);
    scrambler.scramble(after, weights);
    EXPECT_LT(scrambler.octave_error(), 0.02);
    for (std::size_t i = 0; i < weights.size(); ++i)
        if (weights[i] == 0) {
            EXPECT_TRUE(
                std::equal(&before.rgba[4 * i], &before.rgba[4 * i + 4], &after.rgba[4 * i]));
        }
    LuminanceSums then, now;
    then.add(before, weights);
    now.add(after, weights);
    EXPECT_NEAR(now.mean(), then.mean(), 0.01 * then.mean());
    EXPECT_NEAR(now.sd(), then.sd(), 0.01 * then.sd() + 3e-4) << "and what rounding to bytes adds";
}

}  // namespace
}  // namespace risorius::media
