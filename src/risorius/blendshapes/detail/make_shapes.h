// SPDX-License-Identifier: MIT
/// \file
/// Makes blend shapes by simulation. Every shape of a set is the equilibrium of the face under its drive, on the vertices of the
/// imported mesh.
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
    /// For a shape on top of another (ShapeGoal::on_top_of): the weight of both shapes at which it was solved. For larger
    /// weights, the shape is extrapolated linearly.
    double solved_at = 1;
    ShapeCertificate certificate;
};

struct MadeShapes {
    std::vector<MadeShape> list;
    /// Largest distance between the sum of two halves (left and right) and the shape with both sides, over all such pairs, m.
    double halves_error_m = 0;
    bool mirrored = false;  ///< whether the head is symmetric, so that its sides can be compared
};

/// Solves and measures all shapes of a set. `solver` provides the faces. The progress that is reported goes from 0 to 1. Throws
/// Interrupted when the monitor asks to stop.
MadeShapes make_shapes(const scene::RigFiles& files, const ShapeSet& set, const ShapeSolver& solver,
                       const ProgressMonitor& monitor = {});

/// Returns the mesh with a shape at weight 1, V x 3, m, head frame. If the shape is on top of another one, that one is also at
/// weight 1.
Points shown_pose(const MadeShapes& shapes, std::size_t index, const Points& rest);

}  // namespace risorius::blendshapes
