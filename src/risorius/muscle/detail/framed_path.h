// SPDX-License-Identifier: MIT
/// \file
/// A smooth path through points, with a frame of three axes at every point. The cross-sections of a muscle are perpendicular to
/// it.
///
///   s   fraction of the length, 0..1; on a closed path 1 is the same as 0
///   t   along the path      n   outward      b = n x t   across: (t, b, n) is right-handed
///
/// Between the points the path is a Catmull-Rom curve whose knots are separated by the square root of the chord (centripetal),
/// so that it has no loops or cusps where points are unevenly spaced. n is the outward direction that is given at the points,
/// made perpendicular to t. Where none is given, n rotates about the path as little as possible (W. Wang, B. Juettler, D. Zheng
/// & Y. Liu, "Computation of rotation minimizing frames", ACM TOG 27(1), 2008). On a closed path, the difference between n at
/// the start and n after one round is distributed evenly.
#pragma once

#include <string>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::muscle {

/// The frame t, b, n at one point of a path.
struct PathFrame {
    Vec3 at = Vec3::Zero();
    Vec3 along = Vec3::UnitX(), across = Vec3::UnitY(), outward = Vec3::UnitZ();
    /// Curvature vector d along / d length, 1/m. It points to the centre of the bend, and its length is 1 / radius.
    Vec3 bend = Vec3::Zero();
    double knot = 0;  ///< index of the point before it, plus the fraction of the way to the next
};

/// A path through given points.
class FramedPath {
  public:
    /// Needs at least 2 points, or 3 for a closed path, which does not repeat its first point. `outward` has a row per point,
    /// one row for all, or none. With none, n begins as the normal of a closed path's plane, otherwise as +z (+x for a path
    /// that begins along z). Throws Error, with a path that begins with `place` ("place/path_m/3", "place/outward/0"), for
    /// values that are not finite, points that coincide, and an outward direction along the path.
    FramedPath(const Points& through, const Points& outward, bool closed, const std::string& place);

    double length_m() const { return length_.back(); }
    bool closed() const { return closed_; }
    PathFrame frame(double s) const;

    /// Rotates n about the path by `angle`, rad, everywhere.
    void turn(double angle) { turn_ += angle; }

  private:
    int spans() const { return static_cast<int>(through_.rows()) - (closed_ ? 0 : 1); }
    Vec3 point(int i) const;
    Vec3 slope(int i) const;  ///< derivative by the knots at point i
    /// Position, and its first and second derivative by the knots.
    void evaluate(int span, double u, Vec3& at, Vec3& first, Vec3& second) const;
    PathFrame frame_of_sample(std::size_t sample, double fraction) const;
    void carry_outward(const Vec3& first);

    Points through_;
    bool closed_;
    std::vector<double> gap_;     ///< between the knots, one per span
    std::vector<double> length_;  ///< from the start to each sample, m
    std::vector<Vec3> outward_;   ///< at each sample
    double turn_ = 0;
};

/// Interpolates `values`, one for each point of a path, at `knot`. It uses monotone cubic curves (F. N. Fritsch & J. Butland,
/// SIAM J. Sci. Stat. Comput. 5(2), 1984), which stay between the two neighbouring values. A single value is used for the whole
/// path.
double value_along(const std::vector<double>& values, bool closed, double knot);

}  // namespace risorius::muscle
