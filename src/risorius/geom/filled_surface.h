// SPDX-License-Identifier: MIT
/// \file
/// Fills a closed surface with tetrahedra: those of a lattice of cubes, six each, whose middle is inside, with the outer nodes moved onto the
/// surface. Edges and corners of the surface that are finer than the lattice are cut off.
#pragma once

#include "risorius/core/types.h"

namespace risorius::geom {

struct FilledSurface {
    Points nodes;
    Tets tets;  ///< positive volumes, none below a tenth of that in a cube
};

/// What keeps a surface from being filled.
enum class NotFilled {
    kNothing,
    kOpen,       ///< an edge does not have two triangles, or they are wound against each other
    kInsideOut,  ///< triangles face inward
    kTooFine,    ///< more than kMostFillingCubes cubes
    kTooCoarse   ///< no tetrahedron inside
};
inline constexpr double kMostFillingCubes = 400'000;  ///< in the box around the surface

/// `spacing`: edge of the cubes. Returns no tetrahedra, and why, for a surface that cannot be filled.
FilledSurface fill_with_tets(const Points& positions, const Triangles& triangles, double spacing,
                             NotFilled& why);

}  // namespace risorius::geom
