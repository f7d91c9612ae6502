// SPDX-License-Identifier: MIT
#include "risorius/signal/filter.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>

namespace risorius::signal {

namespace {

constexpr double kPi = std::numbers::pi;

/// Factor of K for low-pass filters, and divisor of K for high-pass filters, that gives all passes together the cut-off.
double cutoff_correction(int order, int passes) {
    return std::pow(std::exp2(1.0 / passes) - 1, -0.5 / order);
}

/// The common denominator of all filters: 1 + K/Q s + K^2.
Section resonance(double k, double q) {
    const double norm = 1 / (1 + k / q + k * k);
    return {.b0 = norm, .a1 = 2 * (k * k - 1) * norm, .a2 = (1 - k / q + k * k) * norm};
}

/// Quality of pole pair i.
double pole_quality(int i, int order) { return 0.5 / std::cos(kPi * (2 * i + 1) / (2 * order)); }

void run_section(const Section& s, std::vector<double>& x) {
    // Steady state for the first sample: the states of a direct form II transposed under constant input.
    const double steady = (s.b0 + s.b1 + s.b2) / (1 + s.a1 + s.a2) * x.front();
    double z1 = steady - s.b0 * x.front();
    double z2 = s.b2 * x.front() - s.a2 * steady;
    for (double& value : x) {
        const double out = s.b0 * value + z1;
        z1 = s.b1 * value - s.a1 * out + z2;
        z2 = s.b2 * value - s.a2 * out;
        value = out;
    }
}

}  // namespace

Filter low_pass(int order, double cutoff_hz, double rate_hz, int passes) {
    assert(order >= 2 && order % 2 == 0 && cutoff_hz > 0 && cutoff_hz < rate_hz / 2);
    const double k = std::tan(kPi * cutoff_hz / rate_hz) * cutoff_correction(order, passes);
    Filter filter;
    for (int i = 0; i < order / 2; ++i) {
        Section s = resonance(k, pole_quality(i, order));
        s.b0 *= k * k;
        s.b1 = 2 * s.b0;
        s.b2 = s.b0;
        filter.push_back(s);
    }
    return filter;
}

Filter high_pass(int order, double cutoff_hz, double rate_hz, int passes) {
    assert(order >= 2 && order % 2 == 0 && cutoff_hz > 0 && cutoff_hz < rate_hz / 2);
    const double k = std::tan(kPi * cutoff_hz / rate_hz) / cutoff_correction(order, passes);
    Filter filter;
    for (int i = 0; i < order / 2; ++i) {
        Section s = resonance(k, pole_quality(i, order));
        s.b1 = -2 * s.b0;
        s.b2 = s.b0;
        filter.push_back(s);
    }
    return filter;
}

Filter notch(double hz, double width_hz, double rate_hz) {
    assert(hz > 0 && hz < rate_hz / 2 && width_hz > 0);
    const double k = std::tan(kPi * hz / rate_hz);
    Section s = resonance(k, hz / width_hz);
    s.b0 *= 1 + k * k;
    s.b1 = s.a1;
    s.b2 = s.b0;
    return {s};
}

double gain(const Filter& filter, double hz, double rate_hz) {
    const std::complex<double> z = std::polar(1.0, -2 * kPi * hz / rate_hz);  // delay of one sample
    double product = 1;
    for (const Section& s : filter)
        product *= std::abs((s.b0 + z * (s.b1 + z * s.b2)) / (1.0 + z * (s.a1 + z * s.a2)));
    return product;
}

std::vector<double> filter_both_ways(const Filter& filter, const std::vector<double>& samples,
                                     std::size_t padding) {
    const std::size_t n = samples.size();
    assert(n > padding);
    std::vector<double> x;
    x.reserve(n + 2 * padding);
    for (std::size_t i = padding; i > 0; --i) x.push_back(2 * samples.front() - samples[i]);
    x.insert(x.end(), samples.begin(), samples.end());
    for (std::size_t i = 1; i <= padding; ++i) x.push_back(2 * samples.back() - samples[n - 1 - i]);
    for (int pass = 0; pass < 2; ++pass) {
        for (const Section& section : filter) run_section(section, x);
        std::reverse(x.begin(), x.end());
    }
    const auto begin = x.begin() + static_cast<std::ptrdiff_t>(padding);
    return {begin, begin + static_cast<std::ptrdiff_t>(n)};
}

}  // namespace risorius::signal
