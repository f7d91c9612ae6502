// SPDX-License-Identifier: MIT
// Filters, compared with the frequency response that defines them, and checked for delay and drift, which must not occur.

#include "risorius/signal/filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace risorius::signal {
namespace {

constexpr double kRate = 1000;

/// Butterworth's response of one pass of order n, after the bilinear transform.
double butterworth(double hz, double cutoff_hz, int n) {
    const auto warped = [](double f) { return std::tan(std::numbers::pi * f / kRate); };
    return 1 / std::sqrt(1 + std::pow(warped(hz) / warped(cutoff_hz), 2 * n));
}

TEST(Filter, OnePassHasButterworthsResponse) {
    for (const int order : {2, 4, 8})
        for (const double cutoff : {6.0, 100.0, 450.0}) {
            const Filter low = low_pass(order, cutoff, kRate, 1);
            for (const double hz : {0.5, 5.0, 20.0, 90.0, 300.0, 480.0})
                EXPECT_NEAR(gain(low, hz, kRate), butterworth(hz, cutoff, order), 1e-9)
                    << order << ", " << cutoff << " Hz at " << hz;
            EXPECT_NEAR(gain(low, 0, kRate), 1, 1e-9);
            EXPECT_NEAR(gain(low, cutoff, kRate), std::sqrt(0.5), 1e-9);
            const Filter high = high_pass(order, cutoff, kRate, 1);
            for (const double hz : {5.0, 90.0, 480.0})  // the powers add up to 1
                EXPECT_NEAR(std::pow(gain(high, hz, kRate), 2) + std::pow(gain(low, hz, kRate), 2),
                            1, 1e-8);
        }
}

TEST(Filter, BothPassesTogetherAreAtMinusThreeDecibelAtTheCutOff) {
    for (const int order : {2, 4, 6}) {
        EXPECT_NEAR(std::pow(gain(low_pass(order, 6, kRate), 6, kRate), 2), std::sqrt(0.5), 1e-9);
        EXPECT_NEAR(std::pow(gain(high_pass(order, 20, kRate), 20, kRate), 2), std::sqrt(0.5),
                    1e-9);
    }
}

TEST(Filter, NotchTakesOutItsFrequencyAlone) {
    const Filter filter = notch(50, 4, kRate);
    EXPECT_NEAR(gain(filter, 50, kRate), 0, 1e-9);
    EXPECT_NEAR(gain(filter, 48, kRate), std::sqrt(0.5), 0.02);
    EXPECT_NEAR(gain(filter, 52, kRate), std::sqrt(0.5), 0.02);
    EXPECT_NEAR(gain(filter, 0, kRate), 1, 1e-9);
    EXPECT_GT(gain(filter, 100, kRate), 0.99);
}

/// Amplitude and delay of a sine after both passes, away from its ends.
TEST(Filter, ASineComesOutWeakerButNotLater) {
    const Filter filter = low_pass(2, 6, kRate);
    for (const double hz : {1.0, 6.0, 12.0}) {
        std::vector<double> sine(4000);
        const double omega = 2 * std::numbers::pi * hz / kRate;
        for (std::size_t i = 0; i < sine.size(); ++i) sine[i] = std::sin(omega * double(i));
        const std::vector<double> out = filter_both_ways(filter, sine, 400);
        double in_phase = 0, out_of_phase = 0;  // over whole periods, 1000 samples
        for (std::size_t i = 1500; i < 2500; ++i) {
            in_phase += out[i] * std::sin(omega * double(i)) / 500;
            out_of_phase += out[i] * std::cos(omega * double(i)) / 500;
        }
        EXPECT_NEAR(in_phase, std::pow(gain(filter, hz, kRate), 2), 1e-6) << hz << " Hz";
        EXPECT_NEAR(out_of_phase, 0, 1e-6) << hz << " Hz";
    }
}

TEST(Filter, AConstantStaysAndARampKeepsItsSlopeUpToItsEnds) {
    const Filter filter = low_pass(4, 6, kRate);
    for (const double value : filter_both_ways(filter, std::vector<double>(500, 0.3), 334))
        EXPECT_NEAR(value, 0.3, 1e-12);
    std::vector<double> ramp(1000);
    for (std::size_t i = 0; i < ramp.size(); ++i) ramp[i] = 1e-3 * double(i);
    const std::vector<double> out = filter_both_ways(filter, ramp, 334);
    for (std::size_t i = 0; i < ramp.size(); ++i) EXPECT_NEAR(out[i], ramp[i], 1e-3) << i;
    const Filter high = high_pass(4, 20, kRate);
    for (const double value : filter_both_ways(high, std::vector<double>(500, 0.3), 100))
        EXPECT_NEAR(value, 0, 1e-12);
}

}  // namespace
}  // namespace risorius::signal
