// SPDX-License-Identifier: MIT
/// \file
/// A smooth path through points with a frame at every place on it: what a muscle's cross-sections are set up on.
///
///   s   share of the length, 0..1; of a closed path 1 is 0 again
///   t   along the path      n   outward      b = n x t   across: (t, b, n) is right-handed
///
/// Between the points the path is a Catmull-Rom curve over knots a square root of the chord apart (centripetal), so that
/// it neither loops nor cusps where points lie unevenly. n is what is given at the points, made perpendicular; where
/// nothing is given it turns about the path as little as can be (W. Wang, B. Juettler, D. Zheng & Y. Liu, "Computation of
/// rotation minimizing frames", ACM TOG 27(1), 2008), and a closed path shares out evenly what is missing after one round.
#pragma once

#include <string>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::muscle {

struct PathFrame {
    Vec3 at = Vec3::Zero();
    Vec3 along = Vec3::UnitX(), across = Vec3::UnitY(), outward = Vec3::UnitZ();
    Vec3 bend =
        Vec3::Zero();  ///< d along / d length: towards the centre of the bend, 1 / its radius, 1/m
    double knot = 0;   ///< how many points lie before it, with the share of the way to the next
};

class FramedPath {
  public:
    /// At least 2 points, 3 of a closed path, which does not repeat its first. `outward`: a row per point, one row for
    /// all, or none: then it begins as the normal of a closed path's plane, otherwise as +z (+x for a path that begins
    /// along z). Throws Error below `place` ("/path_m/3", "/outward/0") for what is not finite, points in one place and
    /// an outward direction along the path.
    FramedPath(const Points& through, const Points& outward, bool closed, const std::string& place);

    double length_m() const { return length_.back(); }
    bool closed() const { return closed_; }
    PathFrame frame(double s) const;

    /// Turns n about the path by so much everywhere.
    void turn(double angle) { turn_ += angle; }

  private:
    int spans() const { return static_cast<int>(through_.rows()) - (closed_ ? 0 : 1); }
    Vec3 point(int i) const;
    Vec3 slope(int i) const;  ///< by the knots, at point i
    /// Position, and first and second derivative by the knots.
    void evaluate(int span, double u, Vec3& at, Vec3& first, Vec3& second) const;
    PathFrame frame_of_sample(std::size_t sample, double fraction) const;
    void carry_outward(const Vec3& first);

    Points through_;
    bool closed_;
    std::vector<double> gap_;     ///< of the knots, one per span
    std::vector<double> length_;  ///< from the start to each sample
    std::vector<Vec3> outward_;   ///< at each sample
    double turn_ = 0;
};

/// Values given at the points of a path, between them by monotone cubic curves (F. N. Fritsch & J. Butland, SIAM J. Sci.
/// Stat. Comput. 5(2), 1984), which never leave the range of two neighbours. One value holds everywhere.
double value_along(const std::vector<double>& values, bool closed, double knot);

}  // namespace risorius::muscle
