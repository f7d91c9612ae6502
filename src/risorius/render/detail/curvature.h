// SPDX-License-Identifier: MIT
/// \file
/// Curvature of a surface at its vertices, for subsurface scattering.
#pragma once

#include <vector>

#include "risorius/core/types.h"

namespace risorius::render {

/// Curvature per vertex, 1/m: the turn of the normal per length, averaged over the edges of the vertex, and smoothed. It is 0 for
/// a vertex without triangles. Vertices at the same position (seams) share one value.
std::vector<float> curvature(const Points& rest, const std::vector<unsigned>& triangles);

}  // namespace risorius::render
