// SPDX-License-Identifier: MIT
/// \file
/// Distance to open polylines in space, and smooth curves through landmarks.
#pragma once

#include <vector>

#include "risorius/core/types.h"

namespace risorius::geom {

/// The point of a polyline nearest to a given point: its distance from that point, the index of its segment, and its position on
/// the segment.
struct PolylinePoint {
    double distance_m = 0;
    std::size_t piece = 0;
    double fraction = 0;  ///< position on the segment, 0 at its first point, 1 at its second
};
PolylinePoint nearest_on_polyline(const Vec3& p, const std::vector<Vec3>& line);

/// Returns the distance of p from the polyline, m.
double distance_to_polyline(const Vec3& p, const std::vector<Vec3>& line);

/// Returns points on the Catmull-Rom curve through the given points, at most `spacing_m` apart, both ends included.
std::vector<Vec3> sample_curve(const std::vector<Vec3>& through, double spacing_m);

/// Returns a smooth step of x: 0 below a, 1 above b, and a cubic between them; its derivative is continuous.
inline double smoothstep(double a, double b, double x) {
    const double t = x <= a ? 0.0 : x >= b ? 1.0 : (x - a) / (b - a);
    return t * t * (3.0 - 2.0 * t);
}

}  // namespace risorius::geom
