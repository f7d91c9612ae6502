// SPDX-License-Identifier: MIT
/// \file
/// Finds the weights of a set of shapes that best reproduce a drive. This converts a script for muscles to weights of blend
/// shapes.
///
///   S   drive of every shape, one column each        E   displacement of the face per drive, linearized at rest
///   minimise over w   1/2 |E (S w - d)|^2 + l1_weight sum w,   0 <= w <= 1
///
/// A shape on top of another must not have a larger weight than that one.
#pragma once

#include <vector>

#include "risorius/blendshapes/detail/shape_goals.h"
#include "risorius/face/face.h"
#include "risorius/solve/box_quadratic.h"

namespace risorius::blendshapes {

class ShapeWeights {
  public:
    /// Leaves `face` at rest. The drives of `goals` must be those of its rig. `linear` may be null; else it receives the
    /// linearized displacement for the drive of each goal, V x 3, m.
    ShapeWeights(face::Face& face, const track::ChannelTable& channels,
                 const std::vector<ShapeGoal>& goals, std::vector<Points>* linear = nullptr);

    /// One weight per goal for a drive. Motion of the head is ignored.
    Eigen::VectorXd of(const track::Drive& drive) const;

  private:
    Eigen::VectorXd vector_of(const track::Drive& drive) const;

    std::vector<std::size_t> kinematic_;  ///< kinematic channels that are used
    std::vector<int> on_top_of_;          ///< of each shape, or -1
    Eigen::MatrixXd by_drive_;            ///< S' G, G = E' E
    solve::BoxQuadratic problem_;
};

}  // namespace risorius::blendshapes
