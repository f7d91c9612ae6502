// SPDX-License-Identifier: MIT
/// \file
/// Fits a sphere with centre c and radius r to points p by least squares of |p - c|^2 - r^2.
#pragma once

#include <vector>

#include "risorius/core/types.h"

namespace risorius::geom {

struct Sphere {
    Vec3 centre = Vec3::Zero();
    double radius = 0;
};

/// Returns the sphere in the unit of the points. They must be at least four points that do not all lie in one plane.
Sphere fitted_sphere(const std::vector<Vec3>& points);

}  // namespace risorius::geom
