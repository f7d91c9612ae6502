// SPDX-License-Identifier: MIT
/// \file
/// The line between the lips as seen from the front. Closed lips of a scan are cut along it.
#pragma once

#include <vector>

#include "risorius/rig/head.h"

namespace risorius::rig {

/// The line between the lips: height y and depth z as functions of x, from corner to corner of the mouth, head frame, m. On each
/// side it is a parabola through the landmarks, moved up or down at each x to the deepest point between the lips.
class LipLine {
  public:
    explicit LipLine(const Head& head);

    bool spans(double x) const { return x > right_.x() && x < left_.x(); }
    /// Returns the position along the line: -1 at the right corner, 0 in the middle, 1 at the left corner.
    double across(double x) const;
    Vec3 at(double x) const;

  private:
    static constexpr int kStations = 24;
    double x_of(int i) const { return right_.x() + (left_.x() - right_.x()) * i / kStations; }
    /// Returns the point of the parabola, before it is moved. Both parabolas have a horizontal tangent in the middle.
    Vec3 plain(double x) const;

    Vec3 right_, left_, middle_;
    std::vector<double> offset_;
};

}  // namespace risorius::rig
