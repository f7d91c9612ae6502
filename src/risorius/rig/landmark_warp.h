// SPDX-License-Identifier: MIT
/// \file
/// Thin-plate-spline warp of space that maps landmarks to landmarks (Bookstein 1989), with the kernel |r| of three dimensions.
#pragma once

#include <vector>

#include "risorius/core/types.h"

namespace risorius::rig {

class LandmarkWarp {
  public:
    /// Maps `from` to `to` (row by row). With `smoothing` > 0, m, the map is approximate, so that close pairs may contradict each
    /// other.
    LandmarkWarp(const Points& from, const Points& to, double smoothing = 1e-4);
    Vec3 operator()(const Vec3& p) const;

  private:
    Points from_;
    Eigen::Matrix<double, Eigen::Dynamic, 3> weights_;  ///< rows: kernels, then 1, x, y, z
};

}  // namespace risorius::rig
