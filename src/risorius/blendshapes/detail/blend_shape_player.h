// SPDX-License-Identifier: MIT
/// \file
/// A blend shape rig prepared for playback: the same displacements as float, since reading them takes most of the time of a frame.
#pragma once

#include <vector>

#include "risorius/blendshapes/detail/blend_shape_rig.h"

namespace risorius::blendshapes {

class BlendShapePlayer {
  public:
    explicit BlendShapePlayer(const BlendShapeRig& rig);

    /// Adds to `vertices`, m, the displacement for the weights, one per shape and then one per corrective (BlendShapeRig::all_weights). Equal to
    /// BlendShapeRig::add_to up to the rounding of float.
    void add_to(Points& vertices, const Eigen::VectorXd& all_weights) const;

  private:
    struct Run {  // consecutive vertices
        long first, count;
    };
    struct Shape {
        std::vector<Run> runs;
        std::vector<float> delta;  // m, one run after the other
    };
    std::vector<Shape> shapes_;
};

}  // namespace risorius::blendshapes
