// SPDX-License-Identifier: MIT
#include "risorius/media/phase_scramble.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <random>

namespace risorius::media {

struct PhaseScrambler::Impl {
    // Complex numbers of length 1; their phases are those of real noise, so that pictures stay real.
    cv::Mat turn;
};

PhaseScrambler::PhaseScrambler(int width_px, int height_px, unsigned seed)
    : impl_(std::make_unique<Impl>()) {
    std::mt19937 random(seed);
    cv::Mat noise(height_px, width_px, CV_64F);
    for (int y = 0; y < height_px; ++y)
        for (int x = 0; x < width_px; ++x)
            noise.at<double>(y, x) = static_cast<double>(random()) * 0x1p-32 - 0.5;
    cv::dft(noise, impl_->turn, cv::DFT_COMPLEX_OUTPUT);
    for (int y = 0; y < height_px; ++y)
        for (int x = 0; x < width_px; ++x) {
            cv::Vec2d& one = impl_->turn.at<cv::Vec2d>(y, x);
            const double length = std::hypot(one[0], one[1]);
            one = length > 0 ? one / length : cv::Vec2d(1, 0);
        }
    impl_->turn.at<cv::Vec2d>(0, 0) = cv::Vec2d(1, 0);  // keeps the mean
}

PhaseScrambler::~PhaseScrambler() = default;

void PhaseScrambler::scramble(Image& image) const {
    cv::Mat channel(image.height_px, image.width_px, CV_64F), spectrum;
    for (int k = 0; k < 3; ++k) {
        for (int y = 0; y < image.height_px; ++y)
            for (int x = 0; x < image.width_px; ++x)
                channel.at<double>(y, x) = image.pixel(x, y)[k];
        cv::dft(channel, spectrum, cv::DFT_COMPLEX_OUTPUT);
        cv::mulSpectrums(spectrum, impl_->turn, spectrum, 0);
        cv::idft(spectrum, channel, cv::DFT_REAL_OUTPUT | cv::DFT_SCALE);
        for (int y = 0; y < image.height_px; ++y)
            for (int x = 0; x < image.width_px; ++x)
                image.pixel(x, y)[k] = static_cast<std::uint8_t>(
                    std::lround(std::clamp(channel.at<double>(y, x), 0.0, 255.0)));
    }
}

}  // namespace risorius::media
