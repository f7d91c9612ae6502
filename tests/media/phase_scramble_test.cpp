// SPDX-License-Identifier: MIT
#include "risorius/media/phase_scramble.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstdlib>

namespace risorius::media {
namespace {

constexpr int kWaveWidth = 24, kWaveHeight = 18;

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
            sum += std::polar<double>(image.pixel(x, y)[0],
                                      -2 * 3.14159265358979 *
                                          (static_cast<double>(fx * x) / kWaveWidth +
                                           static_cast<double>(fy * y) / kWaveHeight));
    return std::abs(sum) / (kWaveWidth * kWaveHeight);
}

TEST(PhaseScramble, KeepsTheAmplitudeOfEveryFrequencyAndNothingElse) {
    const PhaseScrambler scrambler(kWaveWidth, kWaveHeight, 7);
    const Image before = waves(0);
    Image after = before;
    scrambler.scramble(after);
    for (const auto& [fx, fy] : {std::pair{0, 0}, {3, 1}, {0, 2}, {5, 5}, {1, 0}})
        EXPECT_NEAR(amplitude(after, fx, fy), amplitude(before, fx, fy), 0.1) << fx << " " << fy;
    long changed = 0;
    for (std::size_t i = 0; i < before.rgba.size(); i += 4)
        changed += std::abs(before.rgba[i] - after.rgba[i]) > 4;
    EXPECT_GT(changed, kWaveWidth * kWaveHeight / 2);
    EXPECT_EQ(after.pixel(3, 3)[3], 200);
    EXPECT_NEAR(after.pixel(5, 5)[2] - after.pixel(5, 5)[0], 20, 1);
}

TEST(PhaseScramble, IsTheSameForTheSameSeedAndLetsStillPicturesStandStill) {
    const PhaseScrambler one(kWaveWidth, kWaveHeight, 7), again(kWaveWidth, kWaveHeight, 7),
        other(kWaveWidth, kWaveHeight, 8);
    Image a = waves(0), b = waves(0), c = waves(0), moved = waves(1);
    one.scramble(a);
    again.scramble(b);
    other.scramble(c);
    one.scramble(moved);
    EXPECT_EQ(a.rgba, b.rgba);
    EXPECT_NE(a.rgba, c.rgba);
    EXPECT_NE(a.rgba, moved.rgba);
}

}  // namespace
}  // namespace risorius::media
