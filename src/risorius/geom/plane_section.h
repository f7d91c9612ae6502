// SPDX-License-Identifier: MIT
/// \file
/// The section of a surface with a plane.
#pragma once

#include <utility>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::geom {

/// Where triangles cut the plane x = `at`: y and z of the ends of segments, in the order of the triangles.
std::vector<std::pair<Vec2, Vec2>> plane_section(const Triangles& triangles, const Points& vertices,
                                                 double at);

}  // namespace risorius::geom
