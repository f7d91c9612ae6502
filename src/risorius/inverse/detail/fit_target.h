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
};

/// Reads a table of measured shapes (.json), shapes.glb of `risorius shapes`, or the shapes of any other glTF file on the rig's mesh. `only`: names; empty: all. Throws Error.
FitTarget given_shapes(const std::filesystem::path& file, const std::vector<std::string>& only,
                       const scene::RigFiles& files, const face::Face& face);

/// Reads mesh files, copies of the rig's mesh with displaced vertices. Throws Error for a wrong file, and Interrupted when `stopped`
/// returns true while another process reads a mesh.
FitTarget given_meshes(const std::vector<std::filesystem::path>& meshes,
                       const scene::RigFiles& files, const face::Face& face,
                       const std::function<bool()>& stopped);

/// Reads a table with the columns time_s and ID.x_mm, ID.y_mm, ID.z_mm, using at most `fps` rows per second. The motion of the
/// head is estimated from landmarks that muscles hardly move, and removed. `max_m`: largest displacement of each of `points` by
/// muscles, m. Throws Error.
FitTarget given_landmarks(const std::filesystem::path& file, int fps,
                          const scene::LandmarkPoints& points, const std::vector<double>& max_m,
                          long vertices);

}  // namespace risorius::inverse
