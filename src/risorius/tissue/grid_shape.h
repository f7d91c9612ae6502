// SPDX-License-Identifier: MIT
/// \file
/// Shapes over a grid of nodes: the cylinder, planes of nodes at which a body can be held, its surface and lines for drawing,
/// and its exact volume.
///
/// The disc is made from the square: (x, y) in [-1, 1]^2 goes to (x sqrt(1 - y^2/2), y sqrt(1 - x^2/2)), which maps the border
/// of the square to the circle.
#pragma once

#include <array>
#include <vector>

#include "risorius/tissue/solid_material.h"

namespace risorius::tissue {

/// A cylinder, MNO x 3, m. Its axis starts at the origin of `place` and follows its x axis and a1. a2 and a3 span the
/// cross-section.
Points cylinder_rest(const GridShape& grid, double radius_m, double length_m,
                     const Rigid& place = Rigid::Identity());

/// The nodes whose index along `axis` (0, 1 or 2) is `index`, ascending.
std::vector<int> plane_nodes(const GridShape& grid, int axis, int index);

/// The six faces of the grid (four for a closed grid), two triangles per quad, counter-clockwise from outside.
Triangles surface_triangles(const GridShape& grid);

/// Every pair of neighbouring nodes, inner ones included, as the solids are drawn in M. Dobsik, Computer Animation of Soft
/// Tissues, Brno 2005.
std::vector<std::array<int, 2>> grid_lines(const GridShape& grid);

/// Signed volume inside the surface, m^3. Each quad is the bilinear patch of its corners, so this is exactly the volume of the
/// trilinear cells.
double enclosed_volume(const GridShape& grid, const Points& x);

}  // namespace risorius::tissue
