// SPDX-License-Identifier: MIT
/// \file
/// Curvature of a surface at its vertices, for subsurface scattering.
#pragma once

#include <vector>

#include "risorius/core/types.h"

namespace risorius::render {

/// Returns the curvature at every vertex, 1/m: the angle (rad) between the normals at the ends of an edge over its length,
/// averaged over the edges of the vertex, and then smoothed. It is 0 for a vertex without triangles. Vertices at the same
/// position (seams) share one value. `triangles`: three vertex indices each.
std::vector<float> curvature(const Points& rest, const std::vector<unsigned>& triangles);

}  // namespace risorius::render
