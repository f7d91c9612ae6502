// SPDX-License-Identifier: MIT
#include "risorius/media/mondrian.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "risorius/media/detail/srgb_light.h"

namespace risorius::media {

namespace {

constexpr double kLeastSide = 0.03, kMostSide = 0.25;  // of the width of the face
// Rectangles for each square of the face's width: all but one point in 1,000 then have some over them
constexpr double kPerSquareWidth = 750;
constexpr int kRounds = 40;

using Light = std::array<double, 3>;

struct Spread {
    double mean = 0, sd = 0;
};

double luminance_of(const Light& light) {
    double y = 0;
    for (std::size_t k = 0; k < 3; ++k) y += detail::kLuma[k] * light[k];
    return y;
}

Light mapped(const Light& light, double gain, double offset) {
    Light out{};
    for (std::size_t k = 0; k < 3; ++k) out[k] = std::clamp(gain * light[k] + offset, 0.0, 1.0);
    return out;
}

Spread spread_of(const std::vector<Light>& pixels, double gain, double offset) {
    double sum = 0, squares = 0;
    for (const Light& pixel : pixels) {
        const double y = luminance_of(mapped(pixel, gain, offset));
        sum += y;
        squares += y * y;
    }
    const auto count = static_cast<double>(pixels.size());
    const double mean = sum / count;
    return {mean, std::sqrt(std::max(squares / count - mean * mean, 0.0))};
}

}  // namespace

void draw(const Mondrian& mondrian, Image& image) {
    std::mt19937 random(mondrian.seed);
    const auto uniform = [&] { return static_cast<double>(random()) * 0x1p-32; };
    const auto side = [&] {
        return std::max(1,
                        static_cast<int>(std::lround(mondrian.face_px * kLeastSide *
                                                     std::pow(kMostSide / kLeastSide, uniform()))));
    };
    const int width = image.width_px, height = image.height_px;
    std::vector<Light> pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                              Light{0.5, 0.5, 0.5});
    const auto count =
        std::llround(kPerSquareWidth * width * height / (mondrian.face_px * mondrian.face_px));
    for (long long i = 0; i < count; ++i) {
        const int w = side(), h = side();
        const int left = static_cast<int>(uniform() * (width + w)) - w,
                  top = static_cast<int>(uniform() * (height + h)) - h;
        Light light{};
        light[0] = uniform();
        light[1] = mondrian.grey ? light[0] : uniform();
        light[2] = mondrian.grey ? light[0] : uniform();
        for (int y = std::max(top, 0); y < std::min(top + h, height); ++y)
            for (int x = std::max(left, 0); x < std::min(left + w, width); ++x)
                pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                       static_cast<std::size_t>(x)] = light;
    }
    // Clipping at black and white changes mean and deviation, so the map is found in rounds.
    double gain = 1, offset = 0;
    for (int round = 0; round < kRounds; ++round) {
        const Spread now = spread_of(pixels, gain, offset);
        if (now.sd > 0) {
            const double change = mondrian.sd / now.sd;
            gain *= change;
            offset = change * offset + mondrian.mean - change * now.mean;
        } else {
            offset += mondrian.mean - now.mean;
        }
    }
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const Light light = mapped(pixels[i], gain, offset);
        for (std::size_t k = 0; k < 3; ++k) image.rgba[4 * i + k] = detail::srgb_of_light(light[k]);
    }
}

}  // namespace risorius::media
