// SPDX-License-Identifier: MIT
/// \file
/// What keeps the end of a muscle before its plate where tendons stand square on a plane and leave it free to drift along.
///
///   x   nodes of the end      c, n   middle and normal of the plate       r   its points from c, without their part along n
///   E = k/2 [ |u|^2 + p^2 w^2 ]      u  mean of x from c, along the plane       w  mean turn about n, sum (n x r).x / sum r^2
///                                    p^2 = mean r^2                             k  stiffness, N/m
///
/// Three linear forms of x, square to each other: narrowing and swelling about the middle stay free, and nothing acts along n.
#pragma once

#include "risorius/core/types.h"
#include "risorius/solve/hessian_builder.h"

namespace risorius::muscle {

class PlaneGuide {
  public:
    PlaneGuide() = default;
    /// Points of the plate at rest, one per node, N x 3.
    PlaneGuide(const Points& plate, const Vec3& normal, double stiffness_n_per_m);

    /// Nodes are N rows of x from `first` on; the plate is moved from rest.
    double energy(const Rigid& plate, const Points& x, int first) const;
    /// On each node, N x 3, N. The plate feels the opposite, in the nodes.
    Points forces(const Rigid& plate, const Points& x, int first) const;
    void add_hessian(const Rigid& plate, int first, solve::HessianBuilder& hessian) const;
    /// Greatest eigenvalue of the second derivative, N/m.
    double stiffest() const { return forms_.size() > 0 ? stiffness_ / count() : 0; }

  private:
    int count() const { return static_cast<int>(forms_.cols()) / 3; }
    /// Gradients of the forms, 3 x 3N, turned with the plate; and what they are of the plate's middle.
    Eigen::MatrixXd forms(const Rigid& plate) const;
    Vec3 values(const Eigen::MatrixXd& forms, const Rigid& plate, const Points& x, int first) const;

    Eigen::MatrixXd forms_;  ///< 3 x 3N at rest; a column triple is a node's
    Vec3 middle_ = Vec3::Zero();
    double stiffness_ = 0;
};

}  // namespace risorius::muscle
