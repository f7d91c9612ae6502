#include "media/luminance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace risorius::media {

namespace {

// Rec. 709
constexpr std::array<double, 3> kShare{0.2126, 0.7152, 0.0722};

using Table = std::array<double, 256>;

/// What a byte of each channel adds to the luminance.
const std::array<Table, 3>& luminance_of_byte() {
    static const std::array<Table, 3> tables = [] {
        std::array<Table, 3> out{};
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t i = 0; i < 256; ++i) {
                const double v = static_cast<double>(i) / 255.0;
                out[k][i] =
                    kShare[k] * (v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
            }
        return out;
    }();
    return tables;
}

}  // namespace

double relative_luminance(const std::uint8_t* rgb) {
    const std::array<Table, 3>& of = luminance_of_byte();
    return of[0][rgb[0]] + of[1][rgb[1]] + of[2][rgb[2]];
}

double mean_luminance(const Image& image, const std::vector<std::uint16_t>& mask) {
    double weight = 0, sum = 0;
    for (std::size_t i = 0; i < mask.size(); ++i) {
        if (mask[i] == 0) continue;
        const std::uint8_t* pixel = image.rgba.data() + 4 * i;
        weight += pixel[3] / 255.0;
        sum += pixel[3] / 255.0 * relative_luminance(pixel);
    }
    return weight > 0 ? sum / weight : std::numeric_limits<double>::quiet_NaN();
}

PictureMeasures LuminanceMeter::measure(const Image& image) {
    const std::size_t pixels = image.rgba.size() / 4;
    std::vector<float> now(pixels);
    // In turn into several sums, which need not wait for each other
    constexpr std::size_t kSums = 4;
    std::array<double, kSums> weights{}, sums{}, squares_of{}, changes{};
    const std::array<Table, 3>& of = luminance_of_byte();
    const bool first = before_.size() != pixels;
    for (std::size_t i = 0; i < pixels; ++i) {
        const std::uint8_t* pixel = image.rgba.data() + 4 * i;
        const double opacity = pixel[3] / 255.0;
        const double y = of[0][pixel[0]] + of[1][pixel[1]] + of[2][pixel[2]];
        const std::size_t k = i % kSums;
        weights[k] += opacity;
        sums[k] += opacity * y;
        squares_of[k] += opacity * y * y;
        now[i] = static_cast<float>(opacity * y);
        const double difference = first ? 0.0 : static_cast<double>(now[i]) - before_[i];
        changes[k] += difference * difference;
    }
    before_ = std::move(now);
    const auto all = [](const std::array<double, kSums>& parts) {
        return (parts[0] + parts[1]) + (parts[2] + parts[3]);
    };
    const double weight = all(weights), sum = all(sums), squares = all(squares_of),
                 change = all(changes);
    PictureMeasures out;
    if (weight == 0) return out;
    out.luminance_mean = sum / weight;
    out.luminance_sd =
        std::sqrt(std::max(0.0, squares / weight - out.luminance_mean * out.luminance_mean));
    out.contrast_rms = out.luminance_mean > 0 ? out.luminance_sd / out.luminance_mean : 0.0;
    out.motion_energy = change / static_cast<double>(pixels);
    return out;
}

}  // namespace risorius::media
