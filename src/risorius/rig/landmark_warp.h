// SPDX-License-Identifier: MIT
/// \file
/// A smooth map of space that takes landmarks to landmarks: the thin-plate spline (Bookstein 1989), with its kernel |r| in three
/// dimensions.
#pragma once

#include <vector>

#include "risorius/core/types.h"

namespace risorius::rig {

class LandmarkWarp {
  public:
    /// Makes the map that takes each row of `from` to the same row of `to`, n x 3, m. With `smoothing` > 0, m, it does so only
    /// approximately, so that landmarks close together may contradict each other.
    LandmarkWarp(const Points& from, const Points& to, double smoothing = 1e-4);
    Vec3 operator()(const Vec3& p) const;

  private:
    Points from_;
    Eigen::Matrix<double, Eigen::Dynamic, 3> weights_;  ///< rows: kernels, then 1, x, y, z
};

}  // namespace risorius::rig
