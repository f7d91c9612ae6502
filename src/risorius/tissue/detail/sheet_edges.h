// SPDX-License-Identifier: MIT
/// \file
/// The edges along which a triangulated sheet folds.
#pragma once

#include <array>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::tissue::detail {

inline Vec3 point(const Points& x, int node) { return x.row(node).transpose(); }

/// An edge as seen from one of its triangles.
struct EdgeSide {
    int low, high;  ///< nodes of the edge, low < high
    int triangle;
    int edge;  ///< it runs from corner `edge` to corner `edge` + 1 (mod 3) of the triangle
};

/// All edges with exactly two triangles, sorted by their nodes. The triangle with the lower number comes first.
std::vector<std::array<EdgeSide, 2>> inner_edges(const Triangles& triangles);

}  // namespace risorius::tissue::detail
