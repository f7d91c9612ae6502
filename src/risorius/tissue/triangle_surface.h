// SPDX-License-Identifier: MIT
/// \file
/// The deformable surface on a triangle mesh as described: the same 14 numbers as on a grid, over material coordinates a
/// that each triangle's corners are given: texture coordinates, or metres along a fibre.
#pragma once

#include <string>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/tissue/surface_material.h"

namespace risorius::tissue {

/// Corners of triangles in material coordinates, F x 6: a1, a2 of each corner in turn.
using CornerCoordinates = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

struct TriangleSurface {
    Triangles triangles;
    Points rest;                    ///< V x 3, m
    CornerCoordinates coordinates;  ///< F x 6
    std::vector<SurfaceMaterial>
        material;  ///< one, or one per triangle; mass is that of one unit of area in a
};

/// The cells of a grid cut in two, with the mean material of their corners. Values meant per node become those that mean
/// the same at this resolution.
TriangleSurface triangulated(const GridSurface& surface);

/// The same surface on irregular triangles: inner nodes moved at random by up to `share` (0 to 0.45) of the spacing, in a
/// and in space alike, and cells cut the way that leaves the wider angles (Delaunay's rule). Nodes keep their index and
/// their material.
TriangleSurface irregularly_triangulated(const GridSurface& surface, double fraction,
                                         unsigned seed);

/// Metres along and across a direction that each triangle is given (F x 3, not normal to it): lambda is then k in N/m,
/// zeta is D in N m and mass is in kg/m^2.
CornerCoordinates fibre_coordinates(const Triangles& triangles, const Points& rest,
                                    const Points& fibre);

const SurfaceMaterial& material_of(const TriangleSurface& surface, Eigen::Index triangle);
/// a of a triangle's corners, one per column, and its area in a.
Eigen::Matrix<double, 2, 3> coordinates_of(const TriangleSurface& surface, Eigen::Index triangle);
double area_of(const Eigen::Matrix<double, 2, 3>& corners);

/// Throws Error with the field named below `place`: wrong sizes, NaN, corners beyond the points, triangles without area at
/// rest or in a, negative or unsymmetric values, no mass.
void check(const TriangleSurface& surface, const std::string& place);

Eigen::VectorXd node_mass(const TriangleSurface& surface);  ///< kg, a third of each triangle's

}  // namespace risorius::tissue
