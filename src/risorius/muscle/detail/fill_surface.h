// SPDX-License-Identifier: MIT
/// \file
/// A grid of nodes that fills a closed surface. Its axis a1 follows the middle line of the body.
#pragma once

#include "risorius/muscle/muscle_shape.h"

namespace risorius::muscle::detail {

/// Returns the nodes of `grid` inside the surface of `shape` (surface_m, triangles), MNO x 3, m. Throws Error with a place that
/// begins with shape.place.
Points fill_surface(const MuscleShape& shape, const tissue::GridShape& grid);

}  // namespace risorius::muscle::detail
