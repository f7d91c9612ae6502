// SPDX-License-Identifier: MIT
/// \file
/// The displacements of a blend shape rig, packed as float for playback. Reading them takes most of the time of a frame.
///
/// PackedShapes adds displacements for given weights. ShapePlayer (shape_player.h) converts a drive to weights and a whole pose.
#pragma once

#include <vector>

#include "risorius/blendshapes/detail/blend_shape_rig.h"

namespace risorius::blendshapes {

class PackedShapes {
  public:
    explicit PackedShapes(const BlendShapeRig& rig);

    /// Adds the displacement for the weights to `vertices`, V x 3, m. There is one weight per shape, then one per corrective
    /// (BlendShapeRig::all_weights). The result equals that of BlendShapeRig::add_to up to the rounding of float.
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
