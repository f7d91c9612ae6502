// SPDX-License-Identifier: MIT
/// \file
/// A grid of nodes that fills a closed surface, its axis a1 along the middle line of the body.
#pragma once

#include "risorius/muscle/muscle_shape.h"

namespace risorius::muscle::detail {

/// Nodes of `grid` within shape.surface_m. Throws Error below shape.place.
Points fill_surface(const MuscleShape& shape, const tissue::GridShape& grid);

}  // namespace risorius::muscle::detail
