// SPDX-License-Identifier: MIT
#include "risorius/media/tone.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <stdexcept>

#include "risorius/media/detail/srgb_light.h"
#include "risorius/media/luminance.h"

namespace risorius::media {

namespace {

constexpr double kNotCut = 1e-12;  // of rounding

double linear_of(int byte) { return detail::light_of_srgb(byte); }
std::uint8_t byte_of(double light) { return detail::srgb_of_light(light); }

}  // namespace

ToneCurve::ToneCurve(const Tone& tone) : tone_(tone) {
    for (int i = 0; i < 256; ++i) {
        const double light = tone.gain * linear_of(i) + tone.offset;
        const auto at = static_cast<std::size_t>(i);
        light_[at] = std::clamp(light, 0.0, 1.0);
        byte_[at] = byte_of(std::clamp(light, 0.0, 1.0));
        // Values that still round to the last byte do not count as clipped.
        is_cut_[at] = light < -kNotCut || light > 1 + kNotCut;
    }
}

double ToneCurve::light_after(const Image& image, std::size_t pixel, std::size_t channel) const {
    if (image.deep.empty()) return light_[image.rgba[4 * pixel + channel]];
    return std::clamp(tone_.gain * light_of(image, pixel, channel) + tone_.offset, 0.0, 1.0);
}

bool ToneCurve::is_cut(const Image& image, std::size_t pixel, std::size_t channel) const {
    if (image.deep.empty()) return is_cut_[image.rgba[4 * pixel + channel]];
    const double light = tone_.gain * light_of(image, pixel, channel) + tone_.offset;
    return light < -kNotCut || light > 1 + kNotCut;
}

void ToneCurve::apply(Image& image) const {
    for (std::size_t i = 0; i < image.rgba.size() / 4; ++i) {
        std::uint8_t* pixel = &image.rgba[4 * i];
        if (image.deep.empty())
            std::transform(pixel, pixel + 3, pixel, [&](std::uint8_t byte) { return byte_[byte]; });
        else
            detail::set_srgb_of_lights(
                {light_after(image, i, 0), light_after(image, i, 1), light_after(image, i, 2)},
                pixel);
    }
    image.deep.clear();
}

void ToneCurve::apply_over(const std::array<std::uint8_t, 3>& background, Image& image) const {
    const std::array<double, 3> behind{linear_of(background[0]), linear_of(background[1]),
                                       linear_of(background[2])};
    for (std::size_t i = 0; i < image.rgba.size() / 4; ++i) {
        const double share = opacity_of(image, i);
        std::uint8_t* pixel = &image.rgba[4 * i];
        std::array<double, 3> light{};
        for (std::size_t k = 0; k < 3; ++k)
            light[k] = share * light_after(image, i, k) + (1 - share) * behind[k];
        if (share == 0)
            std::copy(background.begin(), background.end(), pixel);
        else if (!image.deep.empty())
            detail::set_srgb_of_lights(light, pixel);
        else
            for (std::size_t k = 0; k < 3; ++k)
                pixel[k] = share == 1 ? byte_[pixel[k]] : byte_of(light[k]);
        pixel[3] = 255;
    }
    image.deep.clear();
}

double ToneCurve::cut_off(const Image& image, const std::vector<float>& weights) const {
    double cut = 0, all = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const auto weight = static_cast<double>(weights[i]);
        if (!(weight > 0)) continue;
        all += 3 * weight;
        for (std::size_t k = 0; k < 3; ++k)
            if (is_cut(image, i, k)) cut += weight;
    }
    return all > 0 ? cut / all : 0.0;
}

double ToneCurve::cut_off(const Image& image, const std::vector<std::uint16_t>& mask) const {
    std::size_t cut = 0, all = 0;
    for (std::size_t i = 0; i < image.rgba.size() / 4; ++i) {
        if (!mask.empty() && mask[i] == 0) continue;
        all += 3;
        for (std::size_t k = 0; k < 3; ++k) cut += is_cut(image, i, k) ? 1 : 0;
    }
    return all > 0 ? static_cast<double>(cut) / static_cast<double>(all) : 0.0;
}

void LuminanceSums::add(const Image& image, const std::vector<std::uint16_t>& mask) {
    for (std::size_t i = 0; i < image.rgba.size() / 4; ++i) {
        if (!mask.empty() && mask[i] == 0) continue;
        const double opacity = opacity_of(image, i), y = relative_luminance(image, i);
        weight += opacity;
        sum += opacity * y;
        squares += opacity * y * y;
    }
}

void LuminanceSums::add(const Image& image, const std::vector<float>& weights) {
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const auto w = static_cast<double>(weights[i]);
        if (!(w > 0)) continue;
        const double y = relative_luminance(image, i);
        weight += w;
        sum += w * y;
        squares += w * y * y;
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

namespace {

constexpr int kCellShift = 3;
constexpr double kFitted = 1e-4;
constexpr int kMaxFitSteps = 60;
constexpr double kLeastUncut = 0.2;

}  // namespace

void ColourSums::add(const Image& image, const std::vector<float>& weights) {
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const auto w = static_cast<double>(weights[i]);
        if (!(w > 0)) continue;
        const std::uint8_t* pixel = &image.rgba[4 * i];
        Cell& cell = cells_[(pixel[0] >> kCellShift) << 10 | (pixel[1] >> kCellShift) << 5 |
                            pixel[2] >> kCellShift];
        cell.weight += w;
        double y = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double light = light_of(image, i, k);
            cell.light[k] += w * light;
            y += detail::kLuma[k] * light;
        }
        cell.squares += w * y * y;
    }
}

void ColourSums::add(const ColourSums& others) {
    for (const auto& [at, other] : others.cells_) {
        Cell& cell = cells_[at];
        cell.weight += other.weight;
        for (std::size_t k = 0; k < 3; ++k) cell.light[k] += other.light[k];
        cell.squares += other.squares;
    }
}

ColourSums::Spread ColourSums::after(const Tone& tone) const {
    double weight = 0, sum = 0, squares = 0, cut = 0;
    for (const auto& [at, cell] : cells_) {
        double y = 0, y_before = 0;
        int clipped = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double before = cell.light[k] / cell.weight,
                         after = tone.gain * before + tone.offset;
            y_before += detail::kLuma[k] * before;
            y += detail::kLuma[k] * std::clamp(after, 0.0, 1.0);
            clipped += after < 0 || after > 1;
        }
        // Within the cell, values that are not clipped keep their scatter.
        const double scatter = std::max(0.0, cell.squares / cell.weight - y_before * y_before) *
                               tone.gain * tone.gain * (3 - clipped) / 3;
        weight += cell.weight;
        sum += cell.weight * y;
        squares += cell.weight * (y * y + scatter);
        cut += cell.weight * clipped / 3.0;
    }
    if (!(weight > 0)) return {};
    const double mean = sum / weight;
    return {.mean = mean,
            .sd = std::sqrt(std::max(0.0, squares / weight - mean * mean)),
            .cut = cut / weight};
}

std::string ColourSums::text() const {
    std::string out;
    for (const auto& [at, cell] : cells_) {
        char line[128];
        std::snprintf(line, sizeof line, "%s%d %.7g %.7g %.7g %.7g %.7g", out.empty() ? "" : ";",
                      at, cell.weight, cell.light[0], cell.light[1], cell.light[2], cell.squares);
        out += line;
    }
    return out;
}

ColourSums ColourSums::of_text(const std::string& text) {
    ColourSums out;
    std::istringstream cells(text);
    for (std::string one; std::getline(cells, one, ';');) {
        std::istringstream numbers(one);
        int at = 0;
        Cell cell;
        numbers >> at >> cell.weight >> cell.light[0] >> cell.light[1] >> cell.light[2] >>
            cell.squares;
        if (!numbers || !(cell.weight > 0)) throw std::invalid_argument("no colours: " + one);
        out.cells_[at] = cell;
    }
    return out;
}

FittedTone fitted_tone(const ColourSums& colours, double mean, double sd) {
    const ColourSums::Spread before = colours.after({});
    Tone tone;
    if (before.sd > 0) tone.gain = sd / before.sd;
    tone.offset = mean - tone.gain * before.mean;
    ColourSums::Spread now = colours.after(tone);
    for (int step = 0; step < kMaxFitSteps; ++step) {
        if (std::abs(now.mean - mean) < kFitted && std::abs(now.sd - sd) < kFitted) break;
        const double gain = now.sd > 0 ? tone.gain * sd / now.sd : tone.gain;
        tone.offset += (mean - now.mean) / std::max(1 - now.cut, kLeastUncut) -
                       (gain - tone.gain) * before.mean;
        tone.gain = gain;
        now = colours.after(tone);
    }
    return {tone, now};
}

}  // namespace risorius::media
