// SPDX-License-Identifier: MIT
/// \file
/// Butterworth and notch filters as second-order sections. They run forwards and backwards, so that they have no delay.
///
///   K   tan(pi f / rate): the bilinear transform, which keeps a cut-off at its frequency
///   n   order of one pass; both passes together attenuate like order 2 n
///
/// At the cut-off, the passes together have an amplitude of 1/sqrt(2), -3 dB. A filter designed for two passes is at -1.5 dB
/// there after one pass.
///
/// Sources: A. V. Oppenheim, R. W. Schafer, Discrete-Time Signal Processing; D. A. Winter, Biomechanics and Motor Control of
/// Human Movement, for the correction of the cut-off; F. Gustafsson 1996, IEEE Trans. Signal Process. 44(4), 988-992, for the
/// start in the steady state.
#pragma once

#include <cstddef>
#include <vector>

namespace risorius::signal {

/// y = b0 x + b1 x' + b2 x'' - a1 y' - a2 y''
struct Section {
    double b0 = 1, b1 = 0, b2 = 0, a1 = 0, a2 = 0;
};
using Filter = std::vector<Section>;

/// `order` is even and at least 2; 0 < cutoff_hz < rate_hz / 2. `passes`: how often the filter will run.
Filter low_pass(int order, double cutoff_hz, double rate_hz, int passes = 2);
Filter high_pass(int order, double cutoff_hz, double rate_hz, int passes = 2);
/// Makes a filter that removes the frequency `hz`. The removed band is `width_hz` wide, between the points at which one pass is
/// at -3 dB.
Filter notch(double hz, double width_hz, double rate_hz);

/// Returns the amplitude by which one pass multiplies a sine of the given frequency.
double gain(const Filter& filter, double hz, double rate_hz);

/// Filters the samples forwards, then backwards. Both ends are extended by `padding` samples, reflected about the value at the
/// end. Each pass starts in the steady state of its first sample. Needs more samples than `padding`.
std::vector<double> filter_both_ways(const Filter& filter, const std::vector<double>& samples,
                                     std::size_t padding);

}  // namespace risorius::signal
