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
    Points positions;     ///< W x 3, m; each is that of its first vertex
    Triangles triangles;  ///< the given triangles in order, without those that became degenerate
    std::vector<int> welded_of_vertex;  ///< V; -1 for a vertex that no triangle uses
    std::vector<int> first_vertex;      ///< W, ascending; the lowest vertex joined into each
    std::vector<int> source_triangle;   ///< for each triangle, its row among the given ones

    int joined_count() const;  ///< number of vertices that were replaced by another
};

/// A vertex is joined to the nearest earlier one within the tolerance, or to the one with the lowest index when several are
/// equally near. So the result depends only on the order of vertices.
WeldedSurface weld(const Points& positions, const Triangles& triangles,
                   const WeldOptions& options = {});

/// Copies values of welded vertices to the V vertices of the mesh. Rows of unused vertices are not changed.
void spread(const WeldedSurface& surface, const Points& welded, Points& out);

}  // namespace risorius::geom
