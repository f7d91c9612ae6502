// SPDX-License-Identifier: MIT
/// \file
/// A smooth field of displacements through uncertain ones: kriging, see Rasmussen and Williams 2006, Gaussian Processes for Machine
/// Learning, section 2.2, with two Matern kernels of smoothness 3/2. Far from all points it is zero.
///
///   x   points, n x 3, m      d   displacements there, n x 3, m      s   their standard deviations, m
#pragma once

#include <vector>

#include "risorius/core/types.h"

namespace risorius::landmarks {

class SmoothField {
  public:
    /// Factors the matrix of the points, once for any displacements.
    SmoothField(const Points& x, const std::vector<double>& s);

    void set(const Points& d);
    Vec3 at(const Vec3& p) const;
    Vec3 at_point(Eigen::Index i) const;  ///< the same at row i of x, at once
    /// The standard deviation of each coordinate of the field at a point, m.
    double deviation_at(const Vec3& p) const;

  private:
    Points x_, d_;
    std::vector<double> s_;
    Eigen::MatrixXd inverse_;  ///< of the covariances, n x n
    Points weights_;
};

}  // namespace risorius::landmarks
