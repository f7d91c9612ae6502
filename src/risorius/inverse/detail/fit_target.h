// SPDX-License-Identifier: MIT
/// \file
/// The target of an inverse solve: measured or sculpted shapes, or landmarks over time, as displacements of the head's vertices.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/face.h"
#include "risorius/scene/landmark_points.h"
#include "risorius/scene/rig_files.h"

namespace risorius::inverse {

/// Targets over the same points for all shapes or frames.
struct FitTarget {
    std::vector<std::string> names;
    std::vector<double> times_s;  ///< of each frame, s; empty for shapes
    std::vector<Points> fields;   ///< V x 3 each, m, head frame
    Eigen::VectorXd weight;       ///< V
};

/// Reads a table of "Measured shapes" (.json), or shapes.glb of `risorius shapes`; `only`: names, empty: all. Throws Error.
FitTarget given_shapes(const std::filesystem::path& file, const std::vector<std::string>& only,
                       const scene::RigFiles& files, const face::Face& face);

/// Reads the rig's mesh with displaced vertices. Throws Error.
FitTarget given_meshes(const std::vector<std::filesystem::path>& meshes,
                       const scene::RigFiles& files, const face::Face& face);

/// Reads a table of time_s and ID.x_mm, ID.y_mm, ID.z_mm, at most `fps` rows per second. The motion of the head is removed with the
/// landmarks that muscles hardly move; `max_m`, m, is how far muscles move each of `points`. Throws Error.
FitTarget given_landmarks(const std::filesystem::path& file, int fps,
                          const scene::LandmarkPoints& points, const std::vector<double>& max_m,
                          long vertices);

}  // namespace risorius::inverse
