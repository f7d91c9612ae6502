// The line between the lips as the skin shows it, from the front: where a scan whose lips have grown together is cut.
#pragma once

#include <vector>

#include "risorius/rig/head.h"

namespace risorius::rig {

/// Height and depth over x, corner to corner, head frame, m: a parabola each side through the landmarks, moved up or down
/// to the deepest place between the lips.
class LipLine {
  public:
    explicit LipLine(const Head& head);

    bool spans(double x) const { return x > right_.x() && x < left_.x(); }
    /// From corner to corner, -1 .. 1, 0 in the middle.
    double across(double x) const;
    Vec3 at(double x) const;

  private:
    static constexpr int kStations = 24;
    double x_of(int i) const { return right_.x() + (left_.x() - right_.x()) * i / kStations; }
    /// A parabola each side, level in the middle.
    Vec3 plain(double x) const;

    Vec3 right_, left_, middle_;
    std::vector<double> offset_;
};

}  // namespace risorius::rig
