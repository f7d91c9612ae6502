// A linear rig as it is played: the same displacements in half the bytes, as what a frame costs is reading them.
#pragma once

#include <vector>

#include "risorius/blendshapes/detail/blend_shape_rig.h"

namespace risorius::blendshapes {

class BlendShapePlayer {
  public:
    explicit BlendShapePlayer(const BlendShapeRig& rig);

    /// Adds what the weights, one per shape and then per corrective (LinearRig::all_weights), do to `vertices`, m: as
    /// LinearRig::add_to does, to the last bit of a float.
    void add_to(Points& vertices, const Eigen::VectorXd& all_weights) const;

  private:
    struct Run {  // of vertices in a row
        long first, count;
    };
    struct Shape {
        std::vector<Run> runs;
        std::vector<float> delta;  // m, one run after the other
    };
    std::vector<Shape> shapes_;
};

}  // namespace risorius::blendshapes
