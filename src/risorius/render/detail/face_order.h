// SPDX-License-Identifier: MIT
/// \file
/// Winding of triangles, and the order in which they are drawn fastest. A `Face` is a triangle, not the face of the head.
#pragma once

#include <array>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::render {

using Face = std::array<int, 3>;

/// Reverses triangles where needed, so that each connected component of a closed solid is counter-clockwise seen from outside.
void wind_outwards(const Points& rest, std::vector<Face>& faces);

/// Returns whether the triangles of a surface around the point `inside` are counter-clockwise seen from outside. If they differ,
/// the larger total area decides.
bool is_wound_outwards(const Points& rest, const std::vector<Face>& faces, const Vec3& inside);

/// Sorts the triangles into small clusters, so that each vertex is shaded once. Clusters near the camera come first, so that what
/// they hide fails the depth test and is not shaded.
void order_for_drawing(const Points& rest, const Vec3& camera, std::vector<Face>& faces);

}  // namespace risorius::render
