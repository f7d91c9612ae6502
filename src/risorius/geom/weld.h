// SPDX-License-Identifier: MIT
/// \file
/// Joins a mesh that is split at seams into one surface. Examples are the texture seams of glTF and seams between regions of a
/// face mesh.
///
///   V   vertices of the mesh      W   vertices of the welded surface, W <= V
///
/// By default only boundary vertices are joined, because a seam is a boundary on both sides. Lips that touch, or the root of
/// lashes on a lid, lie inside a surface and must remain separate.
#pragma once

#include <vector>

#include "risorius/core/types.h"

namespace risorius::geom {

/// Which vertices are joined.
struct WeldOptions {
    double tolerance_m = 1e-6;  ///< vertices at most this far apart are joined, [0, inf)
    bool boundary_only = true;  ///< join only vertices at edges with one triangle
};

/// The welded surface, and its relation to the mesh.
struct WeldedSurface {
    Points positions;     ///< W x 3, m; each is the position of first_vertex
    Triangles triangles;  ///< the given triangles in order, without those that became degenerate
    std::vector<int> welded_of_vertex;  ///< V; -1 for a vertex that no triangle uses
    std::vector<int> first_vertex;      ///< W, ascending; the lowest vertex joined into each
    std::vector<int> source_triangle;   ///< for each triangle, its row among the given ones

    int joined_count() const;  ///< number of vertices that were replaced by another
};

/// Welds a mesh. Each vertex is joined to the nearest one of lower index within the tolerance; of several that are equally near,
/// the one of lowest index is taken. So the result depends only on the positions and the order of the vertices.
WeldedSurface weld(const Points& positions, const Triangles& triangles,
                   const WeldOptions& options = {});

/// Copies the rows of `welded` (W x 3) to the corresponding vertices of the mesh in `out` (V x 3). Rows of vertices that no
/// triangle uses are not changed.
void spread(const WeldedSurface& surface, const Points& welded, Points& out);

}  // namespace risorius::geom
