// SPDX-License-Identifier: MIT
/// \file
/// A weak spring that keeps the end of a muscle in front of its plate. It is needed where tendons are perpendicular to a plane:
/// they do not prevent the end from moving along it.
///
///   x   nodes of the end      c, n   middle and normal of the plate       r   points of the plate minus c, in the plane
///   E = k/2 [ |u|^2 + p^2 w^2 ]      u  mean of x from c, along the plane    w  mean rotation about n, sum (n x r).x / sum r^2
///                                    p^2 = mean r^2                          k  stiffness, N/m
///
/// u (two components) and w are three linear functions ("forms") of x, which are orthogonal. So the end can become narrower and
/// wider about its middle without force, and no force acts along n.
#pragma once

#include "risorius/core/types.h"
#include "risorius/solve/hessian_builder.h"

namespace risorius::muscle {

/// The spring of one end of a muscle.
class PlaneGuide {
  public:
    PlaneGuide() = default;
    /// `plate`: points of the plate in its rest pose, one per node of the end, N x 3, m.
    PlaneGuide(const Points& plate, const Vec3& normal, double stiffness_n_per_m);

    /// Energy, J. The nodes are N rows of x, beginning at `first`. `plate` is the motion of the plate from its rest pose.
    double energy(const Rigid& plate, const Points& x, int first) const;
    /// Forces on each node, N x 3, N. The opposite forces act on the plate, at the positions of the nodes.
    Points forces(const Rigid& plate, const Points& x, int first) const;
    void add_hessian(const Rigid& plate, int first, solve::HessianBuilder& hessian) const;
    /// Maximum eigenvalue of the second derivative, N/m.
    double stiffest() const { return forms_.size() > 0 ? stiffness_ / count() : 0; }

  private:
    int count() const { return static_cast<int>(forms_.cols()) / 3; }
    /// Gradients of the forms, 3 x 3N, rotated with the plate.
    Eigen::MatrixXd forms(const Rigid& plate) const;
    Vec3 values(const Eigen::MatrixXd& forms, const Rigid& plate, const Points& x, int first) const;

    Eigen::MatrixXd forms_;  ///< 3 x 3N in the rest pose; three columns for each node
    Vec3 middle_ = Vec3::Zero();
    double stiffness_ = 0;
};

}  // namespace risorius::muscle
