// SPDX-License-Identifier: MIT
#include "risorius/signal/emg_envelope.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "risorius/signal/filter.h"

namespace risorius::signal {

namespace {

constexpr double kNotchWidth_hz = 4;

std::size_t two_periods(double hz, double rate_hz) {
    return static_cast<std::size_t>(std::ceil(2 * rate_hz / hz));
}

}  // namespace

std::size_t padding_of(const EmgFilters& filters, double rate_hz) {
    std::size_t max = 0;
    if (filters.band_pass_hz)
        max = std::max(max, two_periods(filters.band_pass_hz->front(), rate_hz));
    if (!filters.notch_hz.empty()) max = std::max(max, two_periods(kNotchWidth_hz, rate_hz));
    if (filters.low_pass_hz) max = std::max(max, two_periods(*filters.low_pass_hz, rate_hz));
    return max;
}

std::vector<double> emg_envelope(std::vector<double> samples, double rate_hz,
                                 const EmgFilters& filters) {
    const std::size_t padding = padding_of(filters, rate_hz);
    const auto apply = [&](const Filter& filter) {
        samples = filter_both_ways(filter, samples, padding);
    };
    for (const double hz : filters.notch_hz) apply(notch(hz, kNotchWidth_hz, rate_hz));
    if (filters.band_pass_hz) {
        apply(high_pass(filters.order, filters.band_pass_hz->front(), rate_hz));
        apply(low_pass(filters.order, filters.band_pass_hz->back(), rate_hz));
    }
    if (filters.rectify)
        for (double& value : samples) value = std::abs(value);
    if (filters.low_pass_hz) apply(low_pass(filters.order, *filters.low_pass_hz, rate_hz));
    // A low-pass filter overshoots below zero at a steep edge.
    for (double& value : samples) value = std::max(value, 0.0);
    return samples;
}

double percentile(std::vector<double> samples, double percent) {
    assert(!samples.empty() && percent >= 0 && percent <= 100);
    std::sort(samples.begin(), samples.end());
    const double place = percent / 100 * static_cast<double>(samples.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    if (below + 1 >= samples.size()) return samples.back();
    return samples[below] +
           (place - static_cast<double>(below)) * (samples[below + 1] - samples[below]);
}

}  // namespace risorius::signal
