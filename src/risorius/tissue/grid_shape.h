// SPDX-License-Identifier: MIT
/// \file
/// Shapes over a grid of nodes: the round body, planes of nodes to hold it by, its surface and lines for drawing, and the
/// volume it really has.
///
/// Source of the disc from the square: (x, y) in [-1, 1]^2 goes to (x sqrt(1 - y^2/2), y sqrt(1 - x^2/2)), which takes the
/// border of the square to the circle.
#pragma once

#include <array>
#include <vector>

#include "risorius/tissue/solid_material.h"

namespace risorius::tissue {

/// A cylinder whose axis runs from the origin of `place` along its x axis, material axis a1 with it; a2 and a3 span the
/// cross-section.
Points cylinder_rest(const GridShape& grid, double radius_m, double length_m,
                     const Rigid& place = Rigid::Identity());

/// Nodes whose index along `axis` (0, 1 or 2) is `index`, in ascending order.
std::vector<int> plane_nodes(const GridShape& grid, int axis, int index);

/// The six faces (of a closed grid the four along it), two triangles per quad, seen counter-clockwise from outside.
Triangles surface_triangles(const GridShape& grid);

/// Every pair of neighbouring nodes, inner ones too, as the thesis draws its solids.
std::vector<std::array<int, 2>> grid_lines(const GridShape& grid);

/// Signed volume within those faces, m^3. Each quad is the bilinear patch through its corners, so that the volume is
/// that of the trilinear cells exactly.
double enclosed_volume(const GridShape& grid, const Points& x);

}  // namespace risorius::tissue
