// SPDX-License-Identifier: MIT
/// \file
/// Finds self-intersections of a surface: triangles that share no vertex and intersect each other.
///
/// Two triangles in general position intersect when an edge of one passes through the other; both are tested. Pairs that only touch, to a
/// billionth of their size, do not count, nor do coplanar ones.
/// Segment against triangle: Moeller & Trumbore 1997, J. Graphics Tools 2(1), 21-28.
#pragma once

#include <array>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::geom {

/// Pairs of triangles, the smaller index first, ascending.
std::vector<std::array<int, 2>> self_intersections(const Points& positions,
                                                   const Triangles& triangles);

}  // namespace risorius::geom
