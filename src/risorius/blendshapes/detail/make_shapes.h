// SPDX-License-Identifier: MIT
/// \file
/// Makes blend shapes from simulation: every shape of a set is the equilibrium pose of its drive, on the mesh as imported.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "risorius/blendshapes/detail/shape_certificate.h"
#include "risorius/blendshapes/detail/shape_goals.h"
#include "risorius/blendshapes/detail/shape_solver.h"
#include "risorius/blendshapes/detail/sparse_shape.h"
#include "risorius/core/progress_monitor.h"
#include "risorius/scene/rig_files.h"

namespace risorius::blendshapes {

struct MadeShape {
    ShapeGoal goal;
    blendshapes::SparseShape shape;  ///< head frame, m
    std::array<Mat3, 2> eye_rotation{Mat3::Identity(), Mat3::Identity()};
    /// For a shape on top of another: the weight of both at which it was solved. Beyond it, the shape is extrapolated linearly.
    double solved_at = 1;
    ShapeCertificate certificate;
};

struct MadeShapes {
    std::vector<MadeShape> list;
    /// Largest distance between the sum of two halves and the whole, m.
    double halves_error_m = 0;
    bool mirrored = false;  ///< whether the head is symmetric, so that its sides can be compared
};

/// Solves and measures all shapes of a set. `solver` provides the faces. The monitor gets fractions from 0 to 1. Throws
/// Interrupted.
MadeShapes make_shapes(const scene::RigFiles& files, const ShapeSet& set, const ShapeSolver& solver,
                       const ProgressMonitor& monitor = {});

/// The mesh with a shape at weight 1, V x 3, m, head frame. For a shape on top of another, that one is also at weight 1.
Points shown_pose(const MadeShapes& shapes, std::size_t index, const Points& rest);

}  // namespace risorius::blendshapes
