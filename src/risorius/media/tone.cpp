// SPDX-License-Identifier: MIT
#include "risorius/media/tone.h"

#include <algorithm>
#include <cmath>

#include "risorius/media/luminance.h"

namespace risorius::media {

namespace {

// sRGB, IEC 61966-2-1
double linear_of(int byte) {
    const double v = byte / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

std::uint8_t byte_of(double linear) {
    const double v =
        linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(v, 0.0, 1.0)));
}

}  // namespace

ToneCurve::ToneCurve(const Tone& tone) {
    for (int i = 0; i < 256; ++i) {
        const double light = tone.gain * linear_of(i) + tone.offset;
        const auto at = static_cast<std::size_t>(i);
        byte_[at] = byte_of(std::clamp(light, 0.0, 1.0));
        // Values that still round to the last byte do not count as clipped.
        is_cut_[at] = light < linear_of(0) - 1e-12 || light > linear_of(255) + 1e-12;
    }
}

void ToneCurve::apply(Image& image) const {
    image.deep.clear();
    for (std::size_t i = 0; i < image.rgba.size(); ++i)
        if (i % 4 != 3) image.rgba[i] = byte_[image.rgba[i]];
}

double ToneCurve::cut_off(const Image& image, const std::vector<std::uint16_t>& mask) const {
    std::size_t cut = 0, all = 0;
    for (std::size_t i = 0; i < image.rgba.size() / 4; ++i) {
        if (!mask.empty() && mask[i] == 0) continue;
        const std::uint8_t* pixel = &image.rgba[4 * i];
        all += 3;
        for (int k = 0; k < 3; ++k) cut += is_cut_[pixel[k]] ? 1 : 0;
    }
    return all > 0 ? static_cast<double>(cut) / static_cast<double>(all) : 0.0;
}

void LuminanceSums::add(const Image& image, const std::vector<std::uint16_t>& mask) {
    for (std::size_t i = 0; i < image.rgba.size() / 4; ++i) {
        if (!mask.empty() && mask[i] == 0) continue;
        const std::uint8_t* pixel = &image.rgba[4 * i];
        const double opacity = pixel[3] / 255.0, y = relative_luminance(pixel);
        weight += opacity;
        sum += opacity * y;
        squares += opacity * y * y;
    }
}

void LuminanceSums::add(const LuminanceSums& others) {
    weight += others.weight;
    sum += others.sum;
    squares += others.squares;
}

double LuminanceSums::sd() const {
    return weight > 0 ? std::sqrt(std::max(0.0, squares / weight - mean() * mean())) : 0.0;
}

Tone tone_between(const LuminanceSums& from, double mean, double sd) {
    Tone tone;
    if (from.sd() > 0) tone.gain = sd / from.sd();
    tone.offset = mean - tone.gain * from.mean();
    return tone;
}

}  // namespace risorius::media
