// SPDX-License-Identifier: MIT
/// \file
/// Reads the animations of a glTF 2.0 file (.glb, .gltf, .vrma) as tracks of nodes. What they mean is up to the caller.
///
/// Source: glTF 2.0 specification, Khronos 2021, chapter 3.11; VRMC_vrm_animation 1.0, VRM Consortium 2024.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

namespace risorius::io {

/// What one animation does to one node. Between keys values are linear, or stepped.
struct AnimationTrack {
    int node = 0;
    std::string node_name;
    std::string path;  ///< "translation", "rotation", "scale" or "weights"
    std::vector<std::string>
        targets;  ///< of "weights": the names of the morph targets; empty where the file has none
    std::vector<double> times_s;
    Eigen::MatrixXd values;               ///< keys x 3, 4 (x y z w) or targets
    Eigen::Vector4d at_rest{0, 0, 0, 1};  ///< rotation of the node without animation, x y z w
    bool stepped = false;
};

/// A name that VRMC_vrm_animation gives to a node.
struct VrmNode {
    std::string kind;  ///< "expression", "bone" or "look_at"
    std::string name;
    int node = 0;
};

struct AnimationTracks {
    std::string name;  ///< of the animation; the first is read
    int animations = 0;
    std::vector<AnimationTrack> tracks;
    std::vector<VrmNode> vrm;
};

/// Throws Error.
AnimationTracks read_animation_tracks(const std::filesystem::path& file);

}  // namespace risorius::io
