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

/// Weights and poses of a script, frame by frame.
struct ShapeAnimation {
    std::string name;
    int fps = 60;
    std::vector<std::string> shapes;
    Eigen::MatrixXd weights;           ///< frames x shapes, [0, 1]
    std::vector<track::Drive> drives;  ///< one per frame, for the pose of head and eyes
};

/// Converts the frames of a script to weights of the shapes `goals`. The activation of muscles follows the script over time as in
/// `risorius render`, and the weights of each frame are those for the face in equilibrium.
ShapeAnimation bake_script(const std::filesystem::path& script, const scene::RigFiles& files,
                           const std::vector<ShapeGoal>& goals, const ShapeWeights& weights);

/// Returns a table (CSV) in the format of the app Live Link Face: one row per frame with the 52 shapes of ARKit in their standard
/// order, followed by the rotations of head and eyes, rad. Shapes that the animation does not have stay 0.
std::string live_link_table(const ShapeAnimation& animation);

}  // namespace risorius::blendshapes
