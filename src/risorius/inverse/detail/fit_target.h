// What muscles are sought for: shapes that somebody has measured or sculpted, or landmarks over time, as displacements of the head's
// vertices.
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

/// What is to be met, over all shapes or frames the same points.
struct FitTarget {
    std::vector<std::string> names;
    std::vector<double> times_s;  ///< of frames
    std::vector<Points> fields;   ///< V x 3 each, m, head frame
    Eigen::VectorXd weight;       ///< V
};

/// A table of "Measured shapes" (.json), or shapes.glb of `risorius shapes`; `only`: names, all when empty. Throws Error.
FitTarget given_shapes(const std::filesystem::path& file, const std::vector<std::string>& only,
                       const scene::RigFiles& files, const face::Face& face);

/// The rig's mesh with its vertices elsewhere. Throws Error.
FitTarget given_meshes(const std::vector<std::filesystem::path>& meshes,
                       const scene::RigFiles& files, const face::Face& face);

/// A table of time_s and ID.x_mm, ID.y_mm, ID.z_mm, at most `fps` rows a second of it. The head's own motion is taken out by
/// landmarks that stay where they are on the skull: `most_m`, m, is how far muscles move each of `points`. Throws Error.
FitTarget given_landmarks(const std::filesystem::path& file, int fps,
                          const scene::LandmarkPoints& points, const std::vector<double>& most_m,
                          long vertices);

}  // namespace risorius::inverse
