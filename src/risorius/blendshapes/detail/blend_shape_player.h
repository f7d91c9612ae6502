// SPDX-License-Identifier: MIT
/// \file
/// A blend shape rig prepared for playback. It stores the displacements as float, because reading them takes most of the time of
/// a frame.
#pragma once

#include <vector>

#include "risorius/blendshapes/detail/blend_shape_rig.h"

namespace risorius::blendshapes {

class BlendShapePlayer {
  public:
    explicit BlendShapePlayer(const BlendShapeRig& rig);

    /// Adds the displacement for the weights to `vertices`, m. The weights are one per shape followed by one per corrective
    /// (BlendShapeRig::all_weights()). The result equals that of BlendShapeRig::add_to() up to the rounding of float.
    void add_to(Points& vertices, const Eigen::VectorXd& all_weights) const;

  private:
    struct Run {  // consecutive vertices
        long first, count;
    };
    struct Shape {
        std::vector<Run> runs;
        std::vector<float> delta;  // m, the runs concatenated
    };
    std::vector<Shape> shapes_;
};

}  // namespace risorius::blendshapes
