// SPDX-License-Identifier: MIT
/// \file
/// The target of an inverse solve: measured or sculpted shapes, or landmarks over time, as displacements of the head's vertices.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/face.h"
#include "risorius/scene/landmark_points.h"
#include "risorius/scene/rig_files.h"

namespace risorius::inverse {

/// Targets over the same vertices for all shapes or frames.
struct FitTarget {
    std::vector<std::string> names;
    std::vector<double> times_s;          ///< time of each frame, s; empty for shapes
    std::vector<Points> fields;           ///< V x 3 each, m, head frame
    Eigen::VectorXd weight;               ///< V, weight of each vertex in the error
    std::vector<std::string> notes = {};  ///< values of landmarks that were missing and are bridged
    /// V, one per frame: how sure each vertex of the frame is, 0 to 1; empty: all are
    std::vector<Eigen::VectorXd> sure = {};
    bool flat = false;        ///< the fields have no depth, and say nothing of it
    std::string set = {};     ///< of landmarks: "rig", or of which points they are
    double sitter_scale = 1;  ///< m of the rig per unit of the sitter
};

/// Reads a table of measured shapes (.json), shapes.glb of `risorius shapes`, or the shapes of any other glTF file on the rig's mesh. `only`: names; empty: all. Throws Error.
FitTarget given_shapes(const std::filesystem::path& file, const std::vector<std::string>& only,
                       const scene::RigFiles& files, const face::Face& face);

/// Reads mesh files, copies of the rig's mesh with displaced vertices. Throws Error for a wrong file, and Interrupted when `stopped`
/// returns true while another process reads a mesh.
FitTarget given_meshes(const std::vector<std::filesystem::path>& meshes,
                       const scene::RigFiles& files, const face::Face& face,
                       const std::function<bool()>& stopped);

}  // namespace risorius::inverse
