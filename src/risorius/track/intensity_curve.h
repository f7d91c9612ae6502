// SPDX-License-Identifier: MIT
/// \file
/// From the intensity of an action unit, the fraction of its full motion that is seen, to the activation of its muscles and the motion of
/// its jaw.
///
/// Tissue stiffens as it is compressed and stretched, so that the first half of an activation moves a face by more than the second
/// half. The curve is the inverse of that response: intensities of 0.25, 0.5 and 0.75 look like a quarter, a half and three quarters.
/// It runs through (0, 0), the three given activations and (1, 1): a monotone cubic (Fritsch & Carlson 1980, SIAM J. Numer. Anal. 17,
/// 238-246) that begins and ends with the slope of its first and last part. A negative intensity gives the negative of its mirror.
///
/// The jaw and the pressure in the mouth have a curve of their own. A jaw that turns evenly does not take the skin of the chin along evenly,
/// because the lips and the neck hold the chin back at the end of the way.
#pragma once

#include <array>

namespace risorius::track {

class IntensityCurve {
  public:
    /// The activation is the intensity.
    IntensityCurve() = default;
    /// `activation`: at the intensities 0.25, 0.5 and 0.75. The values must increase, within (0, 1).
    explicit IntensityCurve(const std::array<double, 3>& activation);

    double activation(double intensity) const;
    bool is_identity() const { return identity_; }
    /// The three activations.
    std::array<double, 3> points() const { return {at_[1], at_[2], at_[3]}; }

  private:
    std::array<double, 5> at_{0, 0.25, 0.5, 0.75, 1};
    std::array<double, 5> slope_{1, 1, 1, 1, 1};
    bool identity_ = true;
};

/// The curves of an action unit. Eyes, head and tongue follow the intensity itself.
struct UnitCurves {
    IntensityCurve muscles;
    IntensityCurve channels;  ///< of the jaw and of the pressure in the mouth
};

}  // namespace risorius::track
