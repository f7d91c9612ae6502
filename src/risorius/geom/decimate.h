// SPDX-License-Identifier: MIT
/// \file
/// Coarsens a triangle surface by half-edge collapse towards a size field, keeping a subset of the original vertices,
/// then flips edges towards larger smallest angles. Deterministic.
///
/// Half-edge collapse: Hoppe 1996, "Progressive meshes"; here ordered by edge length over wanted length.
#pragma once

#include <vector>

#include "risorius/core/types.h"

namespace risorius::geom {

struct DecimateOptions {
    double max_normal_turn_deg =
        50;  ///< a triangle's normal may turn at most this far from its original surface
    double boundary_tolerance =
        0.25;  ///< largest distance of a removable boundary vertex from the new edge / wanted length
    double longest_edge = 1.6;  ///< no edge longer than this, ratio of wanted length
};

struct Decimated {
    Triangles triangles;    ///< over the original vertex indices
    std::vector<int> kept;  ///< original indices of the vertices left, ascending
    std::vector<int>
        collapsed_to;  ///< V, the kept vertex each original vertex went to; -1 if not on the surface
};

/// `length`: wanted edge length at each vertex. Vertices in `keep` (V, may be empty) are never removed. Vertices in `seam` (V, may be empty)
/// lie on an edge along which another surface will be joined: they collapse only along it, and it remains an edge.
Decimated decimate(const Triangles& triangles, const Points& points,
                   const std::vector<double>& length, const std::vector<char>& keep,
                   const DecimateOptions& options = {}, const std::vector<char>& seam = {});

}  // namespace risorius::geom
