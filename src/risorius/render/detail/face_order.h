// SPDX-License-Identifier: MIT
/// \file
/// Order and winding of triangles that are fastest to draw.
#pragma once

#include <array>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::render {

using Face = std::array<int, 3>;

/// Turns each connected piece of a closed solid so that its triangles are counter-clockwise from outside.
void wind_outwards(const Points& rest, std::vector<Face>& faces);

/// Whether a surface that surrounds `inside` is counter-clockwise from outside, by area.
bool is_wound_outwards(const Points& rest, const std::vector<Face>& faces, const Vec3& inside);

/// Small neighbourhoods together (so that vertices are shaded once), near ones first (so that what they hide fails the depth
/// test before it is shaded).
void order_for_drawing(const Points& rest, const Vec3& camera, std::vector<Face>& faces);

}  // namespace risorius::render
