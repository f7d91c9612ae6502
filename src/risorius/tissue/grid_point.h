// SPDX-License-Identifier: MIT
/// \file
/// Any point of a grid body, given by its material coordinates and interpolated from the corners of its cell.
///
///   a   material coordinates, each in [0, 1]     weights: trilinear
#pragma once

#include "risorius/solve/node_blend.h"
#include "risorius/tissue/solid_material.h"

namespace risorius::tissue {

/// Returns the nodes and weights of the point at material coordinates `a`. Coordinates outside [0, 1] are clamped.
solve::NodeBlend point_of_grid(const GridShape& grid, const Vec3& a);

}  // namespace risorius::tissue
