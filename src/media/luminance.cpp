#include "media/luminance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace risorius::media {

namespace {

const std::array<double, 256>& linear_of_srgb() {
    static const std::array<double, 256> table = [] {
        std::array<double, 256> out{};
        for (std::size_t i = 0; i < out.size(); ++i) {
            const double v = static_cast<double>(i) / 255.0;
            out[i] = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
        }
        return out;
    }();
    return table;
}

}  // namespace

double relative_luminance(const std::uint8_t* rgb) {
    const std::array<double, 256>& linear = linear_of_srgb();
    return 0.2126 * linear[rgb[0]] + 0.7152 * linear[rgb[1]] + 0.0722 * linear[rgb[2]];
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
    double weight = 0, sum = 0, squares = 0, change = 0;
    const bool first = before_.size() != pixels;
    for (std::size_t i = 0; i < pixels; ++i) {
        const std::uint8_t* pixel = image.rgba.data() + 4 * i;
        const double opacity = pixel[3] / 255.0, y = relative_luminance(pixel);
        weight += opacity;
        sum += opacity * y;
        squares += opacity * y * y;
        now[i] = static_cast<float>(opacity * y);
        const double difference = first ? 0.0 : static_cast<double>(now[i]) - before_[i];
        change += difference * difference;
    }
    before_ = std::move(now);
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
