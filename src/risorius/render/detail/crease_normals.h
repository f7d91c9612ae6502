// SPDX-License-Identifier: MIT
/// \file
/// Normals of a surface with sharp edges: smooth across small angles between triangles, separate across a crease.
#pragma once

#include <vector>

#include "risorius/core/types.h"

namespace risorius::render {

/// Unit normals, one per corner of every triangle (zero for a triangle without area). Each is the area-weighted mean over the
/// triangles around the vertex of the corner whose normals are within 45 degrees of the corner's own triangle.
std::vector<Vec3> crease_normals(const Points& positions, const Triangles& surface);

}  // namespace risorius::render
