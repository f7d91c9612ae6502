// SPDX-License-Identifier: MIT
/// \file
/// Finds self-intersections of a surface: triangles that intersect and have no vertex in common.
///
/// Two triangles in general position intersect when an edge of one passes through the other; both are tested. Pairs that only
/// touch, up to a billionth of their size, do not count. Coplanar pairs do not count either.
///
/// Source: Moeller & Trumbore 1997, J. Graphics Tools 2(1), 21-28, for segment against triangle.
#pragma once

#include <array>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::geom {

/// Returns the pairs of triangles that intersect, each with the smaller index first, in ascending order.
std::vector<std::array<int, 2>> self_intersections(const Points& positions,
                                                   const Triangles& triangles);

}  // namespace risorius::geom
