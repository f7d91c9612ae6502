// SPDX-License-Identifier: MIT
/// \file
/// Curvature of a surface at its vertices, for subsurface scattering.
#pragma once

#include <vector>

#include "risorius/core/types.h"

namespace risorius::render {

/// Per vertex, 1/m: mean over the edges around it of the turn of the normal per length, smoothed; 0 without triangles.
/// Vertices at one place (seams) share theirs.
std::vector<float> curvature(const Points& rest, const std::vector<unsigned>& triangles);

}  // namespace risorius::render
