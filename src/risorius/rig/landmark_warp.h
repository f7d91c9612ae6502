// SPDX-License-Identifier: MIT
/// \file
/// Thin-plate-spline warp of space through landmark pairs (Bookstein 1989), kernel |r| in three dimensions.
#pragma once

#include <vector>

#include "risorius/core/types.h"

namespace risorius::rig {

class LandmarkWarp {
  public:
    /// Maps `from` onto `to` (same rows). With `smoothing` > 0, m, the map is approximate and close pairs may disagree.
    LandmarkWarp(const Points& from, const Points& to, double smoothing = 1e-4);
    Vec3 operator()(const Vec3& p) const;

  private:
    Points from_;
    Eigen::Matrix<double, Eigen::Dynamic, 3> weights_;  ///< rows: kernels, then 1, x, y, z
};

}  // namespace risorius::rig
