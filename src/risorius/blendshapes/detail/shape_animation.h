// SPDX-License-Identifier: MIT
/// \file
/// Weights of blend shapes over time, and the tables from which other programs play them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "risorius/blendshapes/detail/shape_weights.h"
#include "risorius/core/types.h"
#include "risorius/scene/rig_files.h"
#include "risorius/track/channels.h"

namespace risorius::blendshapes {

struct ShapeAnimation {
    std::string name;
    int fps = 60;
    std::vector<std::string> shapes;
    Eigen::MatrixXd weights;           ///< frames x shapes, [0, 1]
    std::vector<track::Drive> drives;  ///< per frame, for the pose of head and eyes
};

/// Converts the frames of a script to weights of `goals`: muscles follow their drive as in a render, and the face is in equilibrium.
ShapeAnimation bake_script(const std::filesystem::path& script, const scene::RigFiles& files,
                           const std::vector<ShapeGoal>& goals, const ShapeWeights& weights);

/// A table of Live Link Face: a row per frame, the 52 shapes of ARKit in its order, then how head and eyes are turned, rad. Throws
/// Error when the animation is not of those shapes.
std::string live_link_table(const ShapeAnimation& animation);

}  // namespace risorius::blendshapes
