// SPDX-License-Identifier: MIT
/// \file
/// Levels of detail of a mesh with blend shapes: fewer triangles over some of the same vertices, so that shapes, textures, joints and
/// animations follow. Borders between parts stay, so that no gaps open.
///
/// Source: Garland & Heckbert 1997, Surface simplification using quadric error metrics, as in meshoptimizer.
#pragma once

#include "risorius/io/morph_model.h"

namespace risorius::io {

/// Returns the model with about this fraction of its triangles. Small parts keep theirs.
MorphModel coarser_model(const MorphModel& model, double fraction);

/// How far the vertices that a coarser model left out are from its surface.
struct LevelError {
    double surface_m = 0;    ///< the largest distance at rest
    double shape_rms_m = 0;  ///< RMS in the worst shape at weight 1, where only what moves counts
    double shape_max_m = 0;  ///< the largest of all vertices and shapes
    long triangles = 0;      ///< that it has
};
LevelError level_error(const MorphModel& fine, const MorphModel& coarse);

}  // namespace risorius::io
