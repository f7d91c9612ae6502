// SPDX-License-Identifier: MIT
/// \file
/// The closed loops in which planes cut a closed surface.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/muscle/detail/framed_path.h"

namespace risorius::muscle::detail {

/// A closed polygon in the plane of a frame: coordinates (across, outward) of its corners from the origin of the frame, m. The
/// corners are counter-clockwise when one looks against the direction of the path.
using Loop = std::vector<Vec2>;

double loop_area(const Loop& loop);    ///< m^2
Vec2 loop_centroid(const Loop& loop);  ///< m
/// Second moments of area about the centroid along both axes, divided by the area, m^2.
Vec2 loop_spread(const Loop& loop);
/// The angle by which the axes must be rotated so that the first axis is along the direction in which the loop is widest, rad.
double loop_tilt(const Loop& loop);
bool crosses_itself(const Loop& loop);
bool encloses(const Loop& loop, const Vec2& point);

/// A closed surface that can be cut by planes.
class SectionedSurface {
  public:
    /// Throws Error, with a path that begins with `place` ("place/triangles", "place/points_m"), unless the surface is closed,
    /// manifold, connected and oriented outward.
    SectionedSurface(const Points& points, const Triangles& triangles, const std::string& place);

    double volume_m3() const { return volume_; }
    const Vec3& centroid() const { return centroid_; }
    /// Unit vector along the longest direction of the body. `slenderness` is the ratio of the spreads along and across it.
    Vec3 long_axis(double& slenderness) const;
    /// Minimum and maximum of (x - centroid) . axis, m.
    std::array<double, 2> extent(const Vec3& axis) const;
    /// Distance at which a ray from inside first leaves the body, m; infinite when it does not.
    double way_out(const Vec3& from, const Vec3& direction) const;
    /// All loops in the plane perpendicular to frame.along.
    std::vector<Loop> loops(const PathFrame& frame) const;

  private:
    const Points& points_;
    const Triangles& triangles_;
    std::vector<std::array<int, 3>> edge_of_side_;  ///< F x 3
    std::vector<std::array<int, 2>> edges_;
    double volume_ = 0;
    Vec3 centroid_ = Vec3::Zero();
    /// Second moments of volume about the centroid, divided by the volume, m^2.
    Mat3 spread_ = Mat3::Zero();
};

}  // namespace risorius::muscle::detail
