// SPDX-License-Identifier: MIT
#include "risorius/media/luminance_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>

#include "risorius/media/detail/srgb_light.h"
#include "risorius/media/luminance.h"

namespace risorius::media {

namespace {

// Bins of a distribution. Filtered values may lie outside of 0 to 1.
constexpr int kBins = 1 << 16;
constexpr double kLowest = -0.5, kHighest = 1.5;
constexpr double kLeastGain = 0.1, kMostGain = 10;
constexpr int kFitSteps = 40;

/// Cycles per longer side of the picture, rounded.
std::size_t ring_of(int x, int y, int width, int height) {
    const double across = static_cast<double>(std::min(x, width - x)) / width,
                 down = static_cast<double>(std::min(y, height - y)) / height;
    return static_cast<std::size_t>(
        std::lround(std::hypot(across, down) * std::max(width, height)));
}

cv::Mat spectrum_of(const LuminancePlane& plane, double mean) {
    cv::Mat z(plane.height_px, plane.width_px, CV_64F), out;
    for (int y = 0; y < z.rows; ++y)
        for (int x = 0; x < z.cols; ++x) {
            const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(z.cols) +
                                   static_cast<std::size_t>(x);
            z.at<double>(y, x) =
                (static_cast<double>(plane.y[at]) - mean) * static_cast<double>(plane.weights[at]);
        }
    cv::dft(z, out, cv::DFT_COMPLEX_OUTPUT);
    return out;
}

void set_light(double light, std::size_t pixel, std::size_t channel, Image& image) {
    const std::size_t at = 4 * pixel + channel;
    image.rgba[at] = detail::srgb_of_light(light);
    if (!image.deep.empty()) image.deep[at] = detail::deep_srgb_of_light(light);
}

/// T(F(y)), where `from` is the inverse of F.
double curve(const std::vector<double>& from, const std::vector<double>& to, double y) {
    const auto above = std::upper_bound(from.begin(), from.end(), y);
    if (above == from.begin()) return to.front();
    if (above == from.end()) return to.back();
    const auto i = static_cast<std::size_t>(above - from.begin());
    const double part = (y - from[i - 1]) / (from[i] - from[i - 1]);
    return to[i - 1] + part * (to[i] - to[i - 1]);
}

}  // namespace

LuminancePlane luminance_plane(const Image& image, std::vector<float> weights) {
    LuminancePlane out{image.width_px, image.height_px, {}, std::move(weights)};
    out.y.reserve(image.rgba.size() / 4);
    for (std::size_t i = 0; i < image.rgba.size() / 4; ++i)
        out.y.push_back(static_cast<float>(relative_luminance(image, i)));
    return out;
}

void LuminanceDistribution::add(const LuminancePlane& plane) {
    bins_.resize(kBins);
    for (std::size_t i = 0; i < plane.y.size(); ++i) {
        const auto w = static_cast<double>(plane.weights[i]);
        if (!(w > 0)) continue;
        const double at =
            (static_cast<double>(plane.y[i]) - kLowest) / (kHighest - kLowest) * kBins;
        bins_[static_cast<std::size_t>(std::clamp(at, 0.0, kBins - 1.0))] += w;
    }
}

std::vector<double> LuminanceDistribution::quantiles() const {
    double all = 0;
    for (const double bin : bins_) all += bin;
    std::vector<double> out;
    double below = 0;
    std::size_t bin = 0;
    const auto edge = [](std::size_t at) {
        return kLowest + (kHighest - kLowest) * static_cast<double>(at) / kBins;
    };
    for (int i = 0; i < kQuantiles; ++i) {
        const double wanted = all * i / (kQuantiles - 1);
        while (bin + 1 < bins_.size() && (bins_[bin] == 0 || below + bins_[bin] < wanted)) {
            if (bins_[bin] > 0 && below + bins_[bin] >= all * (1 - 1e-12)) break;
            below += bins_[bin++];
        }
        const double part = bins_.empty() || !(bins_[bin] > 0) ? 0 : (wanted - below) / bins_[bin];
        out.push_back(edge(bin) + std::clamp(part, 0.0, 1.0) * (edge(1) - edge(0)));
    }
    return out;
}

double mean_of_quantiles(const std::vector<double>& quantiles) {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < quantiles.size(); ++i)
        sum += (quantiles[i] + quantiles[i + 1]) / 2;
    return sum / static_cast<double>(quantiles.size() - 1);
}

double sd_of_quantiles(const std::vector<double>& quantiles) {
    const double mean = mean_of_quantiles(quantiles);
    double sum = 0;
    for (std::size_t i = 0; i + 1 < quantiles.size(); ++i) {
        const double a = quantiles[i] - mean, b = quantiles[i + 1] - mean;
        sum += (a * a + a * b + b * b) / 3;
    }
    return std::sqrt(sum / static_cast<double>(quantiles.size() - 1));
}

std::vector<double> with_mean_and_sd(std::vector<double> quantiles, double mean, double sd) {
    for (int step = 0; step < kFitSteps; ++step) {
        const double now = mean_of_quantiles(quantiles), spread = sd_of_quantiles(quantiles);
        const double gain = spread > 0 ? sd / spread : 1;
        for (double& one : quantiles) one = std::clamp(mean + gain * (one - now), 0.0, 1.0);
    }
    return quantiles;
}

void RingAmplitudes::add(const LuminancePlane& plane, double mean) {
    const cv::Mat spectrum = spectrum_of(plane, mean);
    std::vector<double> energy, count;
    for (int y = 0; y < spectrum.rows; ++y)
        for (int x = 0; x < spectrum.cols; ++x) {
            const std::size_t ring = ring_of(x, y, spectrum.cols, spectrum.rows);
            if (ring >= energy.size()) {
                energy.resize(ring + 1);
                count.resize(ring + 1);
            }
            const cv::Vec2d& one = spectrum.at<cv::Vec2d>(y, x);
            energy[ring] += one[0] * one[0] + one[1] * one[1];
            ++count[ring];
        }
    if (sums_.size() < energy.size()) sums_.resize(energy.size());
    for (std::size_t ring = 0; ring < energy.size(); ++ring)
        if (count[ring] > 0) sums_[ring] += energy[ring] / count[ring];
    for (const float w : plane.weights) area_ += static_cast<double>(w) * static_cast<double>(w);
}

std::vector<double> RingAmplitudes::amplitudes() const {
    std::vector<double> out;
    for (const double sum : sums_) out.push_back(area_ > 0 ? std::sqrt(sum / area_) : 0);
    return out;
}

double RingAmplitudes::energy(const std::vector<double>& amplitudes, int width_px, int height_px) {
    double sum = 0;
    for (int y = 0; y < height_px; ++y)
        for (int x = 0; x < width_px; ++x)
            if (const std::size_t ring = ring_of(x, y, width_px, height_px);
                ring > 0 && ring < amplitudes.size())
                sum += amplitudes[ring] * amplitudes[ring];
    return sum / width_px / height_px;
}

LuminanceMap::LuminanceMap(std::vector<LuminancePlane>& pictures, const std::vector<double>& target,
                           const std::vector<double>& amplitudes, int rounds)
    : target_(target), mean_(mean_of_quantiles(target)) {
    for (int round = 0; round <= (amplitudes.empty() ? 0 : rounds); ++round) {
        Round next;
        if (round > 0) {
            RingAmplitudes rings;
            for (const LuminancePlane& picture : pictures) rings.add(picture, mean_);
            next.gains = rings.amplitudes();
            for (std::size_t r = 0; r < next.gains.size(); ++r)
                next.gains[r] =
                    r == 0 || r >= amplitudes.size() || !(next.gains[r] > 0)
                        ? 1
                        : std::clamp(amplitudes[r] / next.gains[r], kLeastGain, kMostGain);
        }
        LuminanceDistribution distribution;
        for (LuminancePlane& picture : pictures) {
            apply(next, picture);  // the filter alone
            distribution.add(picture);
        }
        Round after;
        after.from = distribution.quantiles();
        for (LuminancePlane& picture : pictures) apply(after, picture);
        next.from = std::move(after.from);
        rounds_.push_back(std::move(next));
    }
}

void LuminanceMap::apply(const Round& round, LuminancePlane& plane) const {
    if (!round.gains.empty()) {
        cv::Mat spectrum = spectrum_of(plane, mean_), change;
        for (int y = 0; y < spectrum.rows; ++y)
            for (int x = 0; x < spectrum.cols; ++x) {
                const std::size_t ring = ring_of(x, y, spectrum.cols, spectrum.rows);
                spectrum.at<cv::Vec2d>(y, x) *=
                    ring < round.gains.size() ? round.gains[ring] - 1 : 0;
            }
        cv::idft(spectrum, change, cv::DFT_REAL_OUTPUT | cv::DFT_SCALE);
        for (std::size_t i = 0; i < plane.y.size(); ++i)
            if (plane.weights[i] > 0)
                plane.y[i] += static_cast<float>(change.at<double>(
                    static_cast<int>(i / static_cast<std::size_t>(plane.width_px)),
                    static_cast<int>(i % static_cast<std::size_t>(plane.width_px))));
    }
    if (!round.from.empty())
        for (float& y : plane.y)
            y = static_cast<float>(curve(round.from, target_, static_cast<double>(y)));
}

void LuminanceMap::apply(LuminancePlane& plane) const {
    for (const Round& round : rounds_) apply(round, plane);
}

void set_luminance(const std::vector<float>& y, bool grey, Image& image) {
    for (std::size_t i = 0; i < y.size(); ++i) {
        const double wanted = std::clamp(static_cast<double>(y[i]), 0.0, 1.0);
        std::array<double, 3> light{wanted, wanted, wanted};
        if (const double now = relative_luminance(image, i); !grey && now > 0) {
            double most = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                light[k] = light_of(image, i, k) * wanted / now;
                most = std::max(most, light[k]);
            }
            if (most > 1)
                for (double& one : light)
                    one = wanted + (one - wanted) * (1 - wanted) / (most - wanted);
        }
        for (std::size_t k = 0; k < 3; ++k) set_light(light[k], i, k, image);
    }
}

void make_grey(Image& image) {
    for (std::size_t i = 0; i < image.rgba.size() / 4; ++i) {
        const double light = relative_luminance(image, i);
        for (std::size_t k = 0; k < 3; ++k) set_light(light, i, k, image);
    }
}

}  // namespace risorius::media
