// SPDX-License-Identifier: MIT
#include "risorius/track/simulated_emg.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "risorius/signal/filter.h"

namespace risorius::track {

namespace {

constexpr double kRate_hz = 240;  // a multiple of every usual frame rate
constexpr double kLowPass_hz = 6;
constexpr int kOrder = 2;
constexpr long kReach = 120;  // samples to either side; beyond them the kernel is below 1e-7

/// Response of both passes of the filter to one sample, cut at kReach and normalised to sum 1.
std::vector<double> two_sided_kernel() {
    std::vector<double> impulse(static_cast<std::size_t>(4 * kReach + 1), 0.0);
    impulse[static_cast<std::size_t>(2 * kReach)] = 1;
    const std::vector<double> response =
        signal::filter_both_ways(signal::low_pass(kOrder, kLowPass_hz, kRate_hz), impulse, 0);
    std::vector<double> kernel(response.begin() + kReach, response.end() - kReach);
    const double sum = std::accumulate(kernel.begin(), kernel.end(), 0.0);
    for (double& weight : kernel) weight /= sum;
    return kernel;
}

}  // namespace

SimulatedEmg::SimulatedEmg(const ChannelTable& channels, DriveAt drive)
    : drive_(std::move(drive)), min_(channels.column_min()), kernel_(two_sided_kernel()) {}

const Eigen::VectorXd& SimulatedEmg::activity(long sample) {
    while (first_ + static_cast<long>(activity_.size()) <= sample) {
        const long next = first_ + static_cast<long>(activity_.size());
        const Drive drive = drive_(std::max(0.0, static_cast<double>(next) / kRate_hz));
        Eigen::VectorXd u = drive.excitation;
        for (Eigen::Index i = 0; i < u.size(); ++i)
            if (i < drive.activation.size() && !std::isnan(drive.activation[i]))
                u[i] = drive.activation[i];
        activity_.push_back((u - min_).cwiseQuotient((1 - min_.array()).matrix()));
    }
    return activity_[static_cast<std::size_t>(sample - first_)];
}

Eigen::VectorXd SimulatedEmg::envelope(long sample) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(min_.size());
    for (long i = -kReach; i <= kReach; ++i)
        sum += kernel_[static_cast<std::size_t>(i + kReach)] * activity(sample + i);
    return sum;
}

Eigen::VectorXd SimulatedEmg::at(double t_s) {
    const double place = t_s * kRate_hz;
    // The time of a frame is a multiple of 1 / fps only up to rounding.
    const double near = std::round(place);
    const bool is_sample = std::abs(place - near) < 1e-6;
    const long sample = static_cast<long>(is_sample ? near : std::floor(place));

    // Drops old samples, or starts anew after a step back or a large step forward.
    const long begin = sample - kReach;
    if (begin < first_ || begin > first_ + static_cast<long>(activity_.size())) {
        activity_.clear();
        first_ = begin;
    }
    for (; first_ < begin; ++first_) activity_.pop_front();

    Eigen::VectorXd value = envelope(sample);
    if (!is_sample) {
        const double fraction = place - static_cast<double>(sample);
        value = (1 - fraction) * value + fraction * envelope(sample + 1);
    }
    return value.cwiseMax(0.0).cwiseMin(1.0);
}

}  // namespace risorius::track
