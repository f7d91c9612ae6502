// SPDX-License-Identifier: MIT
/// \file
/// Coordinates of a point in the frame of a triangle, with derivatives. The net force and torque of an energy that depends only
/// on these coordinates are exactly zero on the pair of point and triangle.
///
///   a, b, c   corners     p   point     e1 along b - a, e3 normal, e2 = e3 x e1     R = (e1 e2 e3)
///   d = p - (w_a a + w_b b + w_c c), w constant      xi = R^T d
#pragma once

#include <array>

#include "risorius/core/types.h"

namespace risorius::contact {

/// The frame of one pair. The four points are always in the order p, a, b, c.
class CarriedFrame {
  public:
    /// `weights` of the corners have the sum 1. The triangle must have an area.
    CarriedFrame(const Vec3& p, const std::array<Vec3, 3>& corners, const Vec3& weights);

    const Vec3& place() const { return place_; }  ///< xi
    const Mat3& axes() const { return axes_; }    ///< R
    /// Derivative of xi by the position of a point, 3 x 3.
    const Mat3& slope(int point) const { return slope_[point]; }
    /// Second derivative of y . xi by two of the points; its rows are the coordinates of the first.
    Mat3 second_slope(const Vec3& y, int first, int second) const;

  private:
    Vec3 weights_, offset_, place_;  // offset_: d
    Mat3 axes_;
    double length_;             // length of b - a
    std::array<Vec3, 3> turn_;  // e3 x gradient of each barycentric coordinate, 1/m
    double twice_area_;
    std::array<Mat3, 4> spin_;  // rotation of the frame by the motion of each point, 1/m; 0 for p
    std::array<Mat3, 4> slope_;
};

}  // namespace risorius::contact
