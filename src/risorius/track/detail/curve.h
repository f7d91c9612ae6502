// SPDX-License-Identifier: MIT
/// \file
/// A value over time, given by keys. Before the first key and after the last one it is constant. Between keys it is stepped,
/// linear or smooth.
///
/// Smooth is the monotone cubic of Fritsch & Carlson 1980 (SIAM J. Numer. Anal. 17, 238-246): C1 everywhere, and without
/// overshoot between two keys. Its slope is 0 at both ends, where it joins the constant parts.
#pragma once

#include <span>
#include <vector>

namespace risorius::track {

/// Shrinks the slopes at the ends of each part so that its cubic is monotone. `secants`: one for each part; `slopes`: one more.
void keep_monotone(std::span<const double> secants, std::span<double> slopes);

enum class Interpolation { kStep, kLinear, kSmooth };

struct Key {
    double time_s;
    double value;
};

class Curve {
  public:
    /// Needs at least one key; times must increase strictly.
    Curve(std::vector<Key> keys, Interpolation interpolation);

    double at(double t_s) const;

  private:
    std::vector<Key> keys_;
    std::vector<double> slopes_;  ///< at each key; for smooth curves only
    Interpolation interpolation_;
};

/// A value recorded at a constant rate. It is linear between samples, and 0 before the first and after the last sample.
class SampledCurve {
  public:
    /// The first sample is at `start_s`.
    SampledCurve(std::vector<double> samples, double rate_hz, double start_s);

    double at(double t_s) const;

  private:
    std::vector<double> samples_;
    double rate_hz_, start_s_;
};

/// Returns the position in a minimum-jerk movement from 0 to 1, with velocity 0 at both ends. s is the time over the duration; it
/// is clamped to [0, 1]. Source: Flash & Hogan 1985, J. Neurosci. 5, 1688-1703.
double minimum_jerk(double s);

}  // namespace risorius::track
