// SPDX-License-Identifier: MIT
/// \file
/// Closed loops in which planes cut a closed surface.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/muscle/detail/framed_path.h"

namespace risorius::muscle::detail {

/// Corners in the plane of a frame, (across, outward) from its middle, m; counter-clockwise seen against the path.
using Loop = std::vector<Vec2>;

double loop_area(const Loop& loop);
Vec2 loop_centroid(const Loop& loop);
/// Second moments of area over the area along both axes about the centroid, m^2.
Vec2 loop_spread(const Loop& loop);
/// The angle by which the axes have to be turned for the first to lie along the loop's widest direction.
double loop_tilt(const Loop& loop);
bool crosses_itself(const Loop& loop);
bool encloses(const Loop& loop, const Vec2& point);

class SectionedSurface {
  public:
    /// Throws Error below `place` ("/triangles", "/points_m") unless the surface is closed, manifold, of one piece and
    /// turned outward.
    SectionedSurface(const Points& points, const Triangles& triangles, const std::string& place);

    double volume_m3() const { return volume_; }
    const Vec3& centroid() const { return centroid_; }
    /// Unit vector along which the body is longest, and how much longer than across: ratio of the spreads.
    Vec3 long_axis(double& slenderness) const;
    /// Least and greatest of (x - centroid) . axis.
    std::array<double, 2> extent(const Vec3& axis) const;
    /// Where a ray from inside leaves the body first; infinite when it does not.
    double way_out(const Vec3& from, const Vec3& direction) const;
    /// All loops in the plane across frame.along.
    std::vector<Loop> loops(const PathFrame& frame) const;

  private:
    const Points& points_;
    const Triangles& triangles_;
    std::vector<std::array<int, 3>> edge_of_side_;  ///< F x 3
    std::vector<std::array<int, 2>> edges_;
    double volume_ = 0;
    Vec3 centroid_ = Vec3::Zero();
    Mat3 spread_ = Mat3::Zero();  ///< second moments of volume about the centroid over the volume
};

}  // namespace risorius::muscle::detail
