// SPDX-License-Identifier: MIT
/// \file
/// Joins a mesh that is split at seams into one surface: texture seams of glTF, seams between regions of a face mesh.
///
///   V   vertices of the mesh      W   vertices of the welded surface, W <= V
///
/// By default only boundary vertices are joined. A seam is a boundary on both sides, whereas lips that touch, or the root of lashes on a
/// lid, lie inside of a surface and must remain separate.
#pragma once

#include <vector>

#include "risorius/core/types.h"

namespace risorius::geom {

struct WeldOptions {
    double tolerance_m = 1e-6;  ///< vertices no farther apart become one, [0, inf)
    bool boundary_only = true;  ///< join only vertices at edges with one triangle
};

struct WeldedSurface {
    Points positions;                   ///< W x 3, m, each that of its first vertex
    Triangles triangles;                ///< the given ones in order, without those that collapsed
    std::vector<int> welded_of_vertex;  ///< V, -1 for a vertex no triangle uses
    std::vector<int> first_vertex;      ///< W, ascending: the lowest vertex joined into it
    std::vector<int> source_triangle;   ///< per triangle, its row among the given ones

    int joined_count() const;  ///< number of vertices that were replaced by another
};

/// A vertex is joined to the nearest earlier one within the tolerance (the lowest index when equally near), so the result depends only on
/// the order of vertices.
WeldedSurface weld(const Points& positions, const Triangles& triangles,
                   const WeldOptions& options = {});

/// Copies values per welded vertex to the V vertices of the mesh; rows of unused vertices are unchanged.
void spread(const WeldedSurface& surface, const Points& welded, Points& out);

}  // namespace risorius::geom
