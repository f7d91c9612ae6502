// SPDX-License-Identifier: MIT
/// \file
/// Coarsens a triangle surface towards a size field, by half-edge collapse, and then flips edges to enlarge the smallest
/// angles. The vertices that remain are a subset of the original ones. Deterministic.
///
/// Source: Hoppe 1996, "Progressive meshes", for half-edge collapse; here edges are ordered by length / wanted length.
#pragma once

#include <vector>

#include "risorius/core/types.h"

namespace risorius::geom {

/// Limits of collapsing and flipping.
struct DecimateOptions {
    /// Maximum angle between the normal of a triangle and the normal of the original surface there.
    double max_normal_turn_deg = 50;
    /// Maximum distance of a removed boundary vertex from the new boundary edge, over the wanted length.
    double boundary_tolerance = 0.25;
    double longest_edge = 1.6;  ///< maximum length of an edge over the wanted length
};

/// The coarse surface, and where the vertices of the fine one went.
struct Decimated {
    Triangles triangles;    ///< over the original vertex indices
    std::vector<int> kept;  ///< original indices of the remaining vertices, ascending
    /// V; the kept vertex that replaces each original vertex; -1 if not on the surface.
    std::vector<int> collapsed_to;
};

/// Coarsens a surface. `points`: V x 3, m. `length`: V, wanted edge length at each vertex, m. Vertices in `keep` (V, may be
/// empty) are never removed. Vertices in `seam` (V, may be empty) lie on an edge at which another surface will be joined. They
/// collapse only along it, and it remains an edge.
Decimated decimate(const Triangles& triangles, const Points& points,
                   const std::vector<double>& length, const std::vector<char>& keep,
                   const DecimateOptions& options = {}, const std::vector<char>& seam = {});

}  // namespace risorius::geom
