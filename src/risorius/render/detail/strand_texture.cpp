// SPDX-License-Identifier: MIT
#include "risorius/render/detail/strand_texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "risorius/core/counter_rng.h"
#include "risorius/render/detail/gl_context.h"

namespace risorius::render {

std::vector<std::uint8_t> strand_texels(unsigned seed, double white_share) {
    constexpr int kAcross = kStrandSide, kAlong = kStrandSide, kStrands = 900;
    constexpr auto kCount = static_cast<std::size_t>(kAcross) * kAlong;
    // Bundles of some millimetres with gaps between them, and single strands over them, each a little aslant and with ends
    std::vector<float> bright(kCount, 0.0F), white(kCount, 0.0F);
    RandomSequence random(seed * 6007U + 41U);
    double phase[4];
    for (double& one : phase) one = 2 * std::numbers::pi * random.next();
    // Hairs that cling together, a millimetre wide: seen where single ones are not
    constexpr int kClumps = 52;
    std::array<std::array<double, kClumps>, 2> clump;
    for (auto& row : clump)
        for (double& one : row) one = random.next() - 0.5;
    const auto clumped = [&](double u, double v) {
        const double at = (u - std::floor(u)) * kClumps, t = at - std::floor(at);
        const auto a = static_cast<std::size_t>(at) % kClumps, b = (a + 1) % kClumps;
        const double share = 0.5 + 0.5 * std::sin(v);
        const auto of = [&](std::size_t k) {
            return share * clump[0][k] + (1 - share) * clump[1][k];
        };
        const double s = t * t * (3 - 2 * t);
        return (1 - s) * of(a) + s * of(b);
    };
    for (int y = 0; y < kAlong; ++y)
        for (int x = 0; x < kAcross; ++x) {
            const double v = 2 * std::numbers::pi * y / kAlong,
                         u = 2 * std::numbers::pi * x / kAcross + 0.05 * std::sin(v + phase[3]);
            bright[static_cast<std::size_t>(y) * kAcross + static_cast<std::size_t>(x)] =
                static_cast<float>(0.46 + 0.05 * std::sin(5 * u + phase[0]) +
                                   0.03 * std::sin(13 * u + phase[1]) +
                                   0.05 * std::sin(29 * u + 2 * std::sin(v) + phase[2]) +
                                   0.34 * clumped(u / (2 * std::numbers::pi), v));
        }
    for (int i = 0; i < kStrands; ++i) {
        const double at = random.next() * kAcross, from = random.next() * kAlong,
                     length = kAlong * (0.35 + 0.6 * random.next()),
                     slant = 14 * (random.next() - 0.5), half = 0.5 + 0.8 * random.next(),
                     value = random.next();
        const bool is_white = random.next() < white_share;
        for (int j = 0; j < static_cast<int>(length); ++j) {
            const double t = j / length, fade = std::min(1.0, 5 * std::min(t, 1 - t)),
                         x = at + slant * t * t;
            const auto y = static_cast<std::size_t>(static_cast<int>(from) + j) % kAlong;
            for (int dx = -1; dx <= 1; ++dx) {
                const int column = static_cast<int>(std::floor(x)) + dx;
                const double covered =
                    std::clamp(half + 0.5 - std::abs(column + 0.5 - x), 0.0, 1.0) * fade;
                const auto k =
                    y * kAcross + static_cast<std::size_t>((column + 4 * kAcross) % kAcross);
                bright[k] += static_cast<float>(
                    covered * 0.55 * (0.12 + 0.80 * value - static_cast<double>(bright[k])));
                white[k] += static_cast<float>(
                    covered * ((is_white ? 1.0 : 0.0) - static_cast<double>(white[k])));
            }
        }
    }
    std::vector<std::uint8_t> texels(2 * kCount);
    for (std::size_t k = 0; k < kCount; ++k) {
        texels[2 * k] =
            static_cast<std::uint8_t>(std::lround(255 * std::clamp(bright[k], 0.0F, 1.0F)));
        // Hairs lie side by side in every strand, so that none is all white or all dark.
        const auto mixed =
            static_cast<float>(white_share + 0.22 * (static_cast<double>(white[k]) - white_share));
        texels[2 * k + 1] =
            static_cast<std::uint8_t>(std::lround(255 * std::clamp(mixed, 0.0F, 1.0F)));
    }
    return texels;
}

GLuint make_strand_texture(unsigned seed, double white_share) {
    return make_repeating_texture(kStrandSide, kStrandSide, strand_texels(seed, white_share));
}

}  // namespace risorius::render
