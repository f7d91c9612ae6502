// SPDX-License-Identifier: MIT
/// \file
/// The description of the deformable surface on a triangle mesh: the same 14 numbers as on a grid, over material coordinates a.
/// Each triangle has its own a at its corners: texture coordinates, or metres along a fibre.
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
    Triangles triangles;
    Points rest;                    ///< V x 3, m
    CornerCoordinates coordinates;  ///< F x 6
    /// One, or one per triangle; mass is that of one unit of area in a.
    std::vector<SurfaceMaterial> material;
};

/// The cells of a grid, each cut in two, with the mean material of their corners. Values meant per node become those that mean
/// the same at this resolution.
TriangleSurface triangulated(const GridSurface& surface);

/// The same surface on irregular triangles. Inner nodes are moved at random by up to `fraction` (0 to 0.45) of the spacing, in
/// a and in space alike. Cells are cut so that the wider angles remain (Delaunay's rule). Nodes keep their index and their
/// material.
TriangleSurface irregularly_triangulated(const GridSurface& surface, double fraction,
                                         unsigned seed);

/// Material coordinates in metres along and across a direction that is given for each triangle (`fibre`, F x 3, not normal to
/// it). lambda is then k in N/m, zeta is D in N m and mass is in kg/m^2.
CornerCoordinates fibre_coordinates(const Triangles& triangles, const Points& rest,
                                    const Points& fibre);

/// The material of a triangle, when there is one for all triangles or one for each.
const SurfaceMaterial& material_of(const TriangleSurface& surface, Eigen::Index triangle);
/// a of a triangle's corners, one per column.
Eigen::Matrix<double, 2, 3> coordinates_of(const TriangleSurface& surface, Eigen::Index triangle);
/// Area of a triangle in a.
double area_of(const Eigen::Matrix<double, 2, 3>& corners);

/// Throws Error that names the field below `place`: for wrong sizes, NaN, corners beyond the points, triangles without area at
/// rest or in a, negative or unsymmetric values, or no mass.
void check(const TriangleSurface& surface, const std::string& place);

/// kg; a third of the mass of each triangle around the node
Eigen::VectorXd node_mass(const TriangleSurface& surface);

}  // namespace risorius::tissue
