// SPDX-License-Identifier: MIT
/// \file
/// Distance to open polylines in space, and smooth curves through landmarks.
#pragma once

#include <vector>

#include "risorius/core/types.h"

namespace risorius::geom {

/// The point of a polyline nearest to p: its segment, the position along the segment, and the distance.
struct PolylinePoint {
    double distance_m = 0;
    std::size_t piece = 0;
    double fraction = 0;  ///< position on the segment, 0 at its first point, 1 at its second
};
PolylinePoint nearest_on_polyline(const Vec3& p, const std::vector<Vec3>& line);

/// Distance of p to the polyline, m.
double distance_to_polyline(const Vec3& p, const std::vector<Vec3>& line);

/// Catmull-Rom curve through the points, sampled at most `spacing_m` apart; includes the end points.
std::vector<Vec3> sample_curve(const std::vector<Vec3>& through, double spacing_m);

/// Smooth step: 0 below a, 1 above b, C1 between.
inline double smoothstep(double a, double b, double x) {
    const double t = x <= a ? 0.0 : x >= b ? 1.0 : (x - a) / (b - a);
    return t * t * (3.0 - 2.0 * t);
}

}  // namespace risorius::geom
