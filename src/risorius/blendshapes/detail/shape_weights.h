// SPDX-License-Identifier: MIT
/// \file
/// Finds the weights of a set of shapes that come nearest to a drive. With it a script for muscles becomes one for blend shapes.
///
///   S   drive of every shape, one column each        E   displacement of the face per drive, linear at rest
///   minimise over w   1/2 |E (S w - d)|^2 + price sum w,   0 <= w <= 1; of what lies on top of another shape no more than of that
#pragma once

#include <vector>

#include "risorius/blendshapes/detail/shape_goals.h"
#include "risorius/face/face.h"
#include "risorius/solve/box_quadratic.h"

namespace risorius::blendshapes {

class ShapeWeights {
  public:
    /// Leaves `face` at rest. The goals' drives must be of its rig. `linear`, when given, receives the linearised displacement at rest for each
    /// goal's drive, V x 3, m.
    ShapeWeights(face::Face& face, const track::ChannelTable& channels,
                 const std::vector<ShapeGoal>& goals, std::vector<Points>* linear = nullptr);

    /// One weight per goal. The motion of the head is not included.
    Eigen::VectorXd of(const track::Drive& drive) const;

  private:
    Eigen::VectorXd vector_of(const track::Drive& drive) const;

    std::vector<std::size_t> kinematic_;  ///< channels that count
    std::vector<int> on_top_of_;          ///< of each shape, or -1
    Eigen::MatrixXd by_drive_;            ///< S' G, G = E' E
    solve::BoxQuadratic problem_;
};

}  // namespace risorius::blendshapes
