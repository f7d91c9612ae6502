// SPDX-License-Identifier: MIT
/// \file
/// A value over time given by keys. Before the first and after the last key it is constant; between keys it is stepped, linear or smooth.
///
/// Smooth is the monotone cubic of Fritsch & Carlson 1980 (SIAM J. Numer. Anal. 17, 238-246): C1 everywhere, without overshoot between
/// two keys. Its slope is 0 at both ends, where it joins the constant parts.
#pragma once

#include <vector>

namespace risorius::track {

enum class Interpolation { kStep, kLinear, kSmooth };

struct Key {
    double time_s;
    double value;
};

class Curve {
  public:
    /// At least one key, times strictly increasing.
    Curve(std::vector<Key> keys, Interpolation interpolation);

    double at(double t_s) const;

  private:
    std::vector<Key> keys_;
    std::vector<double> slopes_;  ///< at each key, smooth curves only
    Interpolation interpolation_;
};

/// A value recorded at a constant rate: linear between samples, 0 before the first and after the last.
class SampledCurve {
  public:
    /// The first sample is at `start_s`.
    SampledCurve(std::vector<double> samples, double rate_hz, double start_s);

    double at(double t_s) const;

  private:
    std::vector<double> samples_;
    double rate_hz_, start_s_;
};

/// Minimum-jerk movement from 0 to 1, at rest at both ends; s is clamped to [0, 1].
/// Source: Flash & Hogan 1985, J. Neurosci. 5, 1688-1703.
double minimum_jerk(double s);

}  // namespace risorius::track
