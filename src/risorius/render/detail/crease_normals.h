// SPDX-License-Identifier: MIT
/// \file
/// Normals of a surface with edges: smooth where neighbouring triangles turn little, separate across a crease.
#pragma once

#include <vector>

#include "risorius/core/types.h"

namespace risorius::render {

/// One per corner of every triangle, unit length (zero for a triangle without area): the area-weighted mean over the
/// triangles around the corner's vertex that turn by less than 45 degrees from its own.
std::vector<Vec3> crease_normals(const Points& positions, const Triangles& surface);

}  // namespace risorius::render
