// SPDX-License-Identifier: MIT
/// \file
/// The best-fitting sphere of points: least squares of |p - c|^2 - r^2.
#pragma once

#include <vector>

#include "risorius/core/types.h"

namespace risorius::geom {

struct Sphere {
    Vec3 centre = Vec3::Zero();
    double radius = 0;
};

/// Needs at least four points that do not lie in one plane.
Sphere fitted_sphere(const std::vector<Vec3>& points);

}  // namespace risorius::geom
