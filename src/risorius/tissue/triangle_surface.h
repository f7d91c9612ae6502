// SPDX-License-Identifier: MIT
/// \file
/// The description of the deformable surface on a triangle mesh: the same 14 parameters as on a grid, over material coordinates
/// a. Each triangle has material coordinates of its own at its corners: texture coordinates (no unit), or metres along and
/// across a fibre.
#pragma once

#include <string>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/tissue/surface_material.h"

namespace risorius::tissue {

/// Material coordinates of the corners of triangles, F x 6: a1, a2 of each corner in turn.
using CornerCoordinates = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

/// The description of a surface on triangles.
struct TriangleSurface {
    Triangles triangles;            ///< F x 3
    Points rest;                    ///< V x 3, m
    CornerCoordinates coordinates;  ///< F x 6
    /// One, or one per triangle. The mass is that of one unit of area in a.
    std::vector<SurfaceMaterial> material;
};

/// The surface of a grid with each cell cut into two triangles, which have the mean material of the corners of the cell. Values
/// per node (kPerNode) are converted to values that do not depend on the resolution and give the same body.
TriangleSurface triangulated(const GridSurface& surface);

/// The surface of a grid on irregular triangles. Inner nodes are moved at random by up to `fraction` (0 to 0.45) of the
/// spacing, both in a and in space. Each cell is cut along the diagonal that Delaunay's rule selects. Nodes keep their index
/// and their material.
TriangleSurface irregularly_triangulated(const GridSurface& surface, double fraction,
                                         unsigned seed);

/// Material coordinates in metres along and across a direction that is given for each triangle (`fibre`, F x 3, not normal to
/// it). lambda is then the membrane stiffness k in N/m, zeta is the bending stiffness D in N m (SheetConstants), and mass is in
/// kg/m^2.
CornerCoordinates fibre_coordinates(const Triangles& triangles, const Points& rest,
                                    const Points& fibre);

/// The material of a triangle. `surface` has one material for all triangles or one for each.
const SurfaceMaterial& material_of(const TriangleSurface& surface, Eigen::Index triangle);
/// Material coordinates of the corners of a triangle, one corner per column.
Eigen::Matrix<double, 2, 3> coordinates_of(const TriangleSurface& surface, Eigen::Index triangle);
/// Area of a triangle in material coordinates, from the result of coordinates_of().
double area_of(const Eigen::Matrix<double, 2, 3>& corners);

/// Throws Error for wrong sizes, NaN, corners beyond the points, triangles without area at rest or in a, negative or
/// unsymmetric values, or no mass. The message names the field by its path, which begins with `place`.
void check(const TriangleSurface& surface, const std::string& place);

/// Mass of each node, kg: a third of the mass of each triangle around it.
Eigen::VectorXd node_mass(const TriangleSurface& surface);

}  // namespace risorius::tissue
