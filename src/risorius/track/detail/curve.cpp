// SPDX-License-Identifier: MIT
#include "risorius/track/detail/curve.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace risorius::track {

namespace {

std::vector<double> monotone_slopes(const std::vector<Key>& keys) {
    const std::size_t n = keys.size();
    std::vector<double> slopes(n, 0.0), secants(n, 0.0);
    for (std::size_t i = 0; i + 1 < n; ++i)
        secants[i] = (keys[i + 1].value - keys[i].value) / (keys[i + 1].time_s - keys[i].time_s);
    for (std::size_t i = 1; i + 1 < n; ++i)
        if (secants[i - 1] * secants[i] > 0) slopes[i] = (secants[i - 1] + secants[i]) / 2;
    if (n > 0) keep_monotone(std::span<const double>(secants).first(n - 1), slopes);
    return slopes;
}

}  // namespace

// Inside the circle of radius 3 around the secant, the cubic is monotone (condition 4 of Fritsch & Carlson).
void keep_monotone(std::span<const double> secants, std::span<double> slopes) {
    for (std::size_t i = 0; i < secants.size(); ++i) {
        if (secants[i] == 0) continue;
        const double a = slopes[i] / secants[i], b = slopes[i + 1] / secants[i];
        const double squared_radius = a * a + b * b;
        if (squared_radius <= 9) continue;
        const double shrink = 3 / std::sqrt(squared_radius);
        slopes[i] = shrink * a * secants[i];
        slopes[i + 1] = shrink * b * secants[i];
    }
}

Curve::Curve(std::vector<Key> keys, Interpolation interpolation)
    : keys_(std::move(keys)), interpolation_(interpolation) {
    assert(!keys_.empty());
    if (interpolation_ == Interpolation::kSmooth) slopes_ = monotone_slopes(keys_);
}

double Curve::at(double t_s) const {
    const auto after = std::upper_bound(keys_.begin(), keys_.end(), t_s,
                                        [](double t, const Key& key) { return t < key.time_s; });
    if (after == keys_.begin()) return keys_.front().value;
    if (after == keys_.end()) return keys_.back().value;
    const Key& from = *(after - 1);
    const Key& to = *after;
    if (interpolation_ == Interpolation::kStep) return from.value;

    const double h = to.time_s - from.time_s;
    const double s = (t_s - from.time_s) / h;
    if (interpolation_ == Interpolation::kLinear) return from.value + s * (to.value - from.value);

    const auto i = static_cast<std::size_t>(after - keys_.begin()) - 1;
    const double rise = s * s * (3 - 2 * s);
    const double cubic = from.value + rise * (to.value - from.value) +
                         h * s * (1 - s) * ((1 - s) * slopes_[i] - s * slopes_[i + 1]);
    // Monotone up to rounding; the clamp removes the rest.
    return std::clamp(cubic, std::min(from.value, to.value), std::max(from.value, to.value));
}

SampledCurve::SampledCurve(std::vector<double> samples, double rate_hz, double start_s)
    : samples_(std::move(samples)), rate_hz_(rate_hz), start_s_(start_s) {
    assert(rate_hz > 0);
}

double SampledCurve::at(double t_s) const {
    const double place = (t_s - start_s_) * rate_hz_;
    const double last = static_cast<double>(samples_.size()) - 1;
    if (!(place >= 0 && place <= last)) return 0;
    const auto i = static_cast<std::size_t>(place);
    if (i + 1 == samples_.size()) return samples_[i];
    return samples_[i] + (place - static_cast<double>(i)) * (samples_[i + 1] - samples_[i]);
}

double minimum_jerk(double s) {
    s = std::clamp(s, 0.0, 1.0);
    return s * s * s * (10 + s * (-15 + 6 * s));
}

}  // namespace risorius::track
