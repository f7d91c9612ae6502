// SPDX-License-Identifier: MIT
#include "risorius/media/face_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <random>

#include "risorius/media/detail/srgb_light.h"
#include "risorius/media/tone.h"

namespace risorius::media {

namespace {

std::size_t index_of(const Image& image, int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width_px) +
           static_cast<std::size_t>(x);
}

double gain_of_pass(const PassFilter& filter, double f) {
    if (f <= 0) return filter.high ? 0 : 1;
    const double ratio = filter.high ? filter.cut_cycles_per_px / f : f / filter.cut_cycles_per_px;
    return 1 / std::sqrt(1 + std::pow(ratio, 2 * filter.order));
}

double gain_at(const PassFilter& filter, double f) {
    const double gain = gain_of_pass(filter, f);
    if (!filter.low_cut_cycles_per_px) return gain;
    return gain * gain_of_pass({.high = false,
                                .cut_cycles_per_px = *filter.low_cut_cycles_per_px,
                                .order = filter.order},
                               f);
}

/// The mean of each channel within w.
std::array<double, 3> mean_light(const Image& image, const std::vector<float>& weights) {
    std::array<double, 3> sum{};
    double all = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const auto w = static_cast<double>(weights[i]);
        all += w;
        for (std::size_t k = 0; k < 3; ++k)
            sum[k] += w * detail::light_of_srgb(image.rgba[4 * i + k]);
    }
    for (double& one : sum) one /= std::max(all, 1e-12);
    return sum;
}

double sd_of(const Image& image, const std::vector<float>& weights) {
    LuminanceSums sums;
    sums.add(image, weights);
    return sums.sd();
}

/// z of a channel, filtered.
cv::Mat filtered(const PassFilter& filter, const Image& image, const std::vector<float>& weights,
                 int channel, double mean) {
    cv::Mat z(image.height_px, image.width_px, CV_64F), spectrum;
    for (int y = 0; y < z.rows; ++y)
        for (int x = 0; x < z.cols; ++x)
            z.at<double>(y, x) = (detail::light_of_srgb(image.pixel(x, y)[channel]) - mean) *
                                 static_cast<double>(weights[index_of(image, x, y)]);
    cv::dft(z, spectrum, cv::DFT_COMPLEX_OUTPUT);
    for (int y = 0; y < z.rows; ++y)
        for (int x = 0; x < z.cols; ++x)
            spectrum.at<cv::Vec2d>(y, x) *=
                gain_at(filter, std::hypot(std::min(x, z.cols - x) / static_cast<double>(z.cols),
                                           std::min(y, z.rows - y) / static_cast<double>(z.rows)));
    cv::idft(spectrum, z, cv::DFT_REAL_OUTPUT | cv::DFT_SCALE);
    return z;
}

}  // namespace

void filter(const PassFilter& filter, const std::vector<float>& weights, Image& image) {
    const std::array<double, 3> mean = mean_light(image, weights);
    std::array<cv::Mat, 3> z;
    for (std::size_t k = 0; k < 3; ++k)
        z[k] = filtered(filter, image, weights, static_cast<int>(k), mean[k]);
    const Image source = image;
    const auto write = [&](double contrast) {
        for (int y = 0; y < image.height_px; ++y)
            for (int x = 0; x < image.width_px; ++x) {
                const auto w = static_cast<double>(weights[index_of(image, x, y)]);
                if (!(w > 0)) continue;
                for (std::size_t k = 0; k < 3; ++k)
                    image.pixel(x, y)[k] = detail::srgb_of_light(
                        w * mean[k] + contrast * z[k].at<double>(y, x) +
                        (1 - w) * detail::light_of_srgb(source.pixel(x, y)[k]));
            }
    };
    write(1);
    if (!filter.keep_sd) return;
    const double wanted = sd_of(source, weights);
    double contrast = 1;
    for (int step = 0; step < 8; ++step) {
        const double now = sd_of(image, weights);
        if (!(now > 0) || std::abs(now / wanted - 1) < 1e-3) break;
        write(contrast *= wanted / now);
    }
}

void add_noise(double snr_db, unsigned seed, const std::vector<float>& weights, Image& image) {
    const std::array<double, 3> mean = mean_light(image, weights);
    const double kept = 1 / std::sqrt(1 + std::pow(10, -snr_db / 10)),
                 sd = sd_of(image, weights) * kept * std::pow(10, -snr_db / 20);
    std::mt19937 random(seed);
    // The distribution of the standard library differs between libraries; this is the method of Box and Muller.
    const auto uniform = [&] { return (static_cast<double>(random()) + 0.5) * 0x1p-32; };
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const double normal =
            std::sqrt(-2 * std::log(uniform())) * std::cos(2 * 3.14159265358979 * uniform());
        const auto w = static_cast<double>(weights[i]);
        if (!(w > 0)) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint8_t& byte = image.rgba[4 * i + k];
            const double light = detail::light_of_srgb(byte);
            byte = detail::srgb_of_light(w * (mean[k] + kept * (light - mean[k]) + sd * normal) +
                                         (1 - w) * light);
        }
    }
}

void keep_weighted(const std::vector<float>& weights, const std::array<std::uint8_t, 3>& background,
                   Image& image) {
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const auto w = static_cast<double>(weights[i]);
        for (std::size_t k = 0; k < 3 && w < 1; ++k) {
            std::uint8_t& byte = image.rgba[4 * i + k];
            byte = detail::srgb_of_light(w * detail::light_of_srgb(byte) +
                                         (1 - w) * detail::light_of_srgb(background[k]));
        }
    }
}

}  // namespace risorius::media
