// SPDX-License-Identifier: MIT
#include "risorius/media/phase_scramble.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <random>

#include "risorius/media/detail/srgb_light.h"

namespace risorius::media {

namespace {

constexpr unsigned kPhases = 16, kNextPhases = 0x9E3779B9;
constexpr double kGoodOctaves = 0.02;
constexpr int kGainRounds = 40, kLevelRounds = 12;
constexpr double kLeastEnergy = 1e-12;  // an octave with less has no gain

/// The radial frequency of an element of a spectrum, cycles per picture.
double radius(int x, int y, const cv::Mat& of) {
    return std::hypot(std::min(x, of.cols - x), std::min(y, of.rows - y));
}

/// Energy per octave: [1, 2), [2, 4) ... cycles per picture.
std::vector<double> octave_energies(const cv::Mat& picture, std::size_t octaves) {
    cv::Mat spectrum;
    cv::dft(picture, spectrum, cv::DFT_COMPLEX_OUTPUT);
    std::vector<double> out(octaves, 0);
    for (int y = 0; y < spectrum.rows; ++y)
        for (int x = 0; x < spectrum.cols; ++x) {
            const double r = radius(x, y, spectrum);
            if (r < 1) continue;
            const auto octave = std::min(octaves - 1, static_cast<std::size_t>(std::log2(r)));
            const cv::Vec2d& one = spectrum.at<cv::Vec2d>(y, x);
            out[octave] += one[0] * one[0] + one[1] * one[1];
        }
    return out;
}

struct Level {
    double mean = 0, sd = 0;
};

Level level_of(const cv::Mat& picture, const cv::Mat& weights) {
    double weight = 0, sum = 0, squares = 0;
    for (int y = 0; y < picture.rows; ++y)
        for (int x = 0; x < picture.cols; ++x) {
            const double w = weights.at<double>(y, x), v = picture.at<double>(y, x);
            weight += w;
            sum += w * v;
            squares += w * v * v;
        }
    const double mean = sum / weight;
    return {mean, std::sqrt(std::max(0.0, squares / weight - mean * mean))};
}

cv::Mat luminance_of(const std::array<cv::Mat, 3>& channels) {
    return detail::kLuma[0] * channels[0] + detail::kLuma[1] * channels[1] +
           detail::kLuma[2] * channels[2];
}

/// Complex numbers of length 1. Their phases are those of real noise, so that pictures stay real.
cv::Mat random_phases(int width_px, int height_px, unsigned seed) {
    std::mt19937 random(seed);
    cv::Mat noise(height_px, width_px, CV_64F), out;
    for (int y = 0; y < height_px; ++y)
        for (int x = 0; x < width_px; ++x)
            noise.at<double>(y, x) = static_cast<double>(random()) * 0x1p-32 - 0.5;
    cv::dft(noise, out, cv::DFT_COMPLEX_OUTPUT);
    for (int y = 0; y < height_px; ++y)
        for (int x = 0; x < width_px; ++x) {
            cv::Vec2d& one = out.at<cv::Vec2d>(y, x);
            const double length = std::hypot(one[0], one[1]);
            one = length > 0 ? one / length : cv::Vec2d(1, 0);
        }
    out.at<cv::Vec2d>(0, 0) = cv::Vec2d(1, 0);
    return out;
}

}  // namespace

struct PhaseScrambler::Impl {
    unsigned seed = 0;
    cv::Mat turn;  ///< of the phase of each frequency
    cv::Mat gain;  ///< of each frequency; empty before the first picture
    std::size_t octaves = 1;
    double octave_error = 0;

    /// z with shifted phases and the gain.
    cv::Mat shifted(const cv::Mat& z, const cv::Mat& gains) const {
        cv::Mat spectrum, out;
        cv::dft(z, spectrum, cv::DFT_COMPLEX_OUTPUT);
        cv::mulSpectrums(spectrum, turn, spectrum, 0);
        for (int y = 0; y < spectrum.rows; ++y)
            for (int x = 0; x < spectrum.cols; ++x)
                spectrum.at<cv::Vec2d>(y, x) *= gains.at<double>(y, x);
        cv::idft(spectrum, out, cv::DFT_REAL_OUTPUT | cv::DFT_SCALE);
        return out;
    }

    /// The gain of every frequency, linear in log r between nodes in the middles of octaves.
    cv::Mat gains_of(const std::vector<double>& nodes) const {
        cv::Mat out(turn.rows, turn.cols, CV_64F, cv::Scalar(0));
        for (int y = 0; y < out.rows; ++y)
            for (int x = 0; x < out.cols; ++x) {
                const double r = radius(x, y, out);
                if (r < 1) continue;
                const double at =
                    std::clamp(std::log2(r) - 0.5, 0.0, static_cast<double>(nodes.size() - 1));
                const auto low = std::min(nodes.size() - 1, static_cast<std::size_t>(at)),
                           high = std::min(nodes.size() - 1, low + 1);
                const double share = at - static_cast<double>(low);
                out.at<double>(y, x) = (1 - share) * nodes[low] + share * nodes[high];
            }
        return out;
    }

    /// Tries other phases while the octaves cannot be made right with those of the seed.
    void find_gain(const cv::Mat& z, const cv::Mat& weights) {
        octave_error = 1e9;
        cv::Mat best = turn;
        for (unsigned attempt = 0; attempt < kPhases && octave_error > kGoodOctaves; ++attempt) {
            if (attempt > 0) turn = random_phases(z.cols, z.rows, seed + kNextPhases * attempt);
            const double before = octave_error;
            fit_gain(z, weights);
            if (octave_error < before) best = turn;
        }
        turn = best;
    }

    void fit_gain(const cv::Mat& z, const cv::Mat& weights) {
        const std::vector<double> wanted = octave_energies(z, octaves);
        std::vector<double> nodes(octaves, 1);
        for (int round = 0; round < kGainRounds; ++round) {
            const cv::Mat gains = gains_of(nodes);
            const std::vector<double> now =
                octave_energies(shifted(z, gains).mul(weights), octaves);
            double squares = 0;
            for (std::size_t k = 0; k < octaves; ++k)
                if (wanted[k] > kLeastEnergy && now[k] > kLeastEnergy) {
                    squares += std::pow(now[k] / wanted[k] - 1, 2);
                    nodes[k] *= std::sqrt(wanted[k] / now[k]);
                }
            if (const double error = std::sqrt(squares / static_cast<double>(octaves));
                error < octave_error) {
                octave_error = error;
                gain = gains;
            }
        }
    }
};

PhaseScrambler::PhaseScrambler(int width_px, int height_px, unsigned seed)
    : impl_(std::make_unique<Impl>()) {
    impl_->seed = seed;
    impl_->turn = random_phases(width_px, height_px, seed);
    const int half = std::max(2, std::min(width_px, height_px) / 2);
    impl_->octaves = static_cast<std::size_t>(std::ceil(std::log2(half)));
}

PhaseScrambler::~PhaseScrambler() = default;

double PhaseScrambler::octave_error() const { return impl_->octave_error; }

void PhaseScrambler::scramble(Image& image, const std::vector<float>& weights) {
    const int width = image.width_px, height = image.height_px;
    cv::Mat w(height, width, CV_64F);
    std::array<cv::Mat, 3> light, noise;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            w.at<double>(y, x) = static_cast<double>(
                weights[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                        static_cast<std::size_t>(x)]);
    if (!(cv::sum(w)[0] > 0)) return;
    std::array<double, 3> mean{};
    for (int k = 0; k < 3; ++k) {
        cv::Mat& channel = light[static_cast<std::size_t>(k)];
        channel.create(height, width, CV_64F);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                channel.at<double>(y, x) = detail::light_of_srgb(image.pixel(x, y)[k]);
        mean[static_cast<std::size_t>(k)] = level_of(channel, w).mean;
    }
    if (impl_->gain.empty()) {
        const cv::Mat y = luminance_of(light);
        impl_->find_gain((y - level_of(y, w).mean).mul(w), w);
    }
    for (std::size_t k = 0; k < 3; ++k)
        noise[k] = impl_->shifted((light[k] - mean[k]).mul(w), impl_->gain);

    // Scale and level of the noise are corrected until the picture with its clipped values has mean and deviation of the source.
    const Level wanted = level_of(luminance_of(light), w);
    const Level first = level_of(luminance_of(noise), w);
    double scale = first.sd > 0 ? wanted.sd / first.sd : 1, offset = -scale * first.mean;
    std::array<cv::Mat, 3> out;
    for (int round = 0; round < kLevelRounds; ++round) {
        for (std::size_t k = 0; k < 3; ++k) {
            cv::Mat shown = mean[k] + offset + scale * noise[k];
            shown = cv::min(cv::max(shown, 0.0), 1.0);
            out[k] = shown.mul(w) + light[k].mul(1.0 - w);
        }
        const Level now = level_of(luminance_of(out), w);
        if (!(now.sd > 0)) break;
        const double better = scale * wanted.sd / now.sd;
        offset += wanted.mean - now.mean - (better - scale) * first.mean;
        scale = better;
    }
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int k = 0; k < 3 && w.at<double>(y, x) > 0; ++k)
                image.pixel(x, y)[k] =
                    detail::srgb_of_light(out[static_cast<std::size_t>(k)].at<double>(y, x));
}

}  // namespace risorius::media
