// SPDX-License-Identifier: MIT
/// \file
/// Finds the weights of a set of shapes that best reproduce a drive. This converts a script for muscles to weights of blend
/// shapes.
///
///   S   drive of every shape, one column each        E   displacement of the face per drive, linearized at rest
///   minimise over w   1/2 |E (S w - d)|^2 + sum_s p_s w_s,   0 <= w <= 1
///
/// d is the drive to reproduce, w_s the weight of shape s, and p_s = 1e-3 |E S_s|^2 the l1 weight of shape s, where S_s is its
/// column of S. The l1 weight makes most w_s zero. A shape on top of another (ShapeGoal::on_top_of) must not have a larger
/// weight than that one.
#pragma once

#include <vector>

#include "risorius/blendshapes/detail/shape_goals.h"
#include "risorius/face/face.h"
#include "risorius/solve/box_quadratic.h"

namespace risorius::blendshapes {

class ShapeWeights {
  public:
    /// Computes E with `face`, and leaves the face at rest. The drives of `goals` must be those of the rig of the face. If
    /// `linear` is not null, it receives the linearized displacement under the drive of each goal, V x 3, m.
    ShapeWeights(face::Face& face, const track::ChannelTable& channels,
                 const std::vector<ShapeGoal>& goals, std::vector<Points>* linear = nullptr);

    /// Returns one weight per goal for a drive. Motion of the head is ignored.
    Eigen::VectorXd of(const track::Drive& drive) const;

  private:
    Eigen::VectorXd vector_of(const track::Drive& drive) const;

    /// The kinematic channels (those that no muscle drives) that are used
    std::vector<std::size_t> kinematic_;
    std::vector<int> on_top_of_;  ///< of each shape, or -1
    Eigen::MatrixXd by_drive_;    ///< S' G, G = E' E
    solve::BoxQuadratic problem_;
};

}  // namespace risorius::blendshapes
