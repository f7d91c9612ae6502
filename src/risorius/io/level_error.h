// SPDX-License-Identifier: MIT
/// \file
/// What a level of detail (coarser_model.h) costs.
#pragma once

namespace risorius::io {

/// How far the vertices that a coarser model left out are from its surface.
struct LevelError {
    double surface_m = 0;    ///< the largest distance at rest
    double shape_rms_m = 0;  ///< RMS in the worst shape at weight 1, where only what moves counts
    double shape_max_m = 0;  ///< the largest of all vertices and shapes
    long triangles = 0;      ///< that it has
};

}  // namespace risorius::io
