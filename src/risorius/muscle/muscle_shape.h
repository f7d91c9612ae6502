// SPDX-License-Identifier: MIT
/// \file
/// The rest shape of the belly of a muscle, and the grid of nodes that fills it, with the grid axis a1 along the fibres.
///
///   {"block_m": [0.05, 0.02, 0.01]}                                         length, width, thickness
///   {"round": {"length_m": 0.1, "width_m": 0.03, "thickness_m": 0.03, "end_ratio": 0.4}}       fusiform; 1 is a cylinder
///   {"sheet": {"length_m": 0.06, "origin_width_m": 0.08, "insertion_width_m": 0.02, "thickness_m": 0.004}}        a fan
///   {"path": {"path_m": [[0, 0, 0], ..], "outward": [[0, 0, 1]], "width_m": [0.01, ..], "thickness_m": 0.004,
///             "section": "round"}}                                          curved; origin first
///   {"ring": {as path}}                                                     a sphincter, closed along a1
///   {"surface": {"points_m": [[0, 0, 0], ..], "triangles": [[0, 1, 2], ..], "path_m": [[..], [..]]}}   a closed surface
///
/// a1 runs along the fibres, a2 across (width) and a3 outward (thickness). The first three forms begin at the origin of
/// coordinates and extend along x, with the width along y. "path_m" of a surface may be left out; its long axis is then its
/// axis of least inertia.
///
/// The cells of the grid have flat sides on the surface, so the volume of the grid is smaller than that of a rounded body. With
/// "equal_volume" (all forms but blocks and sheets), the cross-sections are scaled until the grid has the volume of the body.
/// Without it, the outermost nodes are on the surface of the body. It is the default of a "surface" in a file.
#pragma once

#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/types.h"
#include "risorius/tissue/solid_material.h"

namespace risorius::muscle {

/// The description of a shape. The form determines which fields are used.
struct MuscleShape {
    enum class Form { kBlock, kRound, kSheet, kPath, kRing, kSurface };
    enum class Section { kBlock, kRound };  ///< a rectangle, or a rectangle mapped to an ellipse

    std::string place = "shape";  ///< the place in the file, for messages
    Form form = Form::kBlock;

    // Block, round, sheet (width at the origin), (0, inf)
    double length_m = 0, width_m = 0, thickness_m = 0;
    double insertion_width_m = 0;  ///< of a sheet                                  (0, inf)
    double end_ratio = 1;          ///< round: size at the ends / size in the middle   (0, 1]

    /// Path and ring: points in the middle of the sections. Surface: points near its middle line, 2 or more, or none.
    Points path_m = {};
    /// Outward directions: one row per point, one for all, or none (framed_path.h). They may have any length.
    Points outward = {};
    /// One per point of the path, or one for all, (0, inf).
    std::vector<double> widths_m = {}, thicknesses_m = {};
    Section section = Section::kRound;  ///< for path and ring

    Points surface_m = {};     ///< V x 3, m
    Triangles triangles = {};  ///< F x 3, counter-clockwise from outside
    /// Fraction of the length that is left out at either end of a surface, where cross-sections become points, [0.001, 0.25].
    double tip_ratio = 0.02;

    bool equal_volume = false;
};

/// Reads an object in one of the forms above. "surface" may name a table in another JSON file. Throws Error; its message names
/// the file and the JSON pointer.
MuscleShape read_muscle_shape(const JsonCursor& json);

/// The grid that fills a shape.
struct Belly {
    tissue::GridShape grid;          ///< closed for a ring
    Points rest;                     ///< M N O x 3, m
    Eigen::VectorXd fibre_length_m;  ///< of each chain of nodes, N O, m; for a ring, of one round
    double volume_m3 = 0;            ///< volume of the grid
};

/// Fills the shape with a grid of at least 2 nodes along each axis, and 3 along a ring. Throws Error, with a place that begins
/// with shape.place, for sizes that are not positive, paths that bend inside their own sections, surfaces that are not closed
/// or whose cross-sections cannot be filled, and cells without positive volume.
Belly muscle_belly(const MuscleShape& shape, const tissue::GridShape& grid);

/// Length of every chain of nodes along a1, N O, m.
Eigen::VectorXd fibre_lengths(const tissue::GridShape& grid, const Points& x);

/// Maps (y, z) in [-1, 1]^2 to the unit disc. The border of the square goes to the circle.
Vec2 square_to_disc(double y, double z);
/// Area of the unit disc divided by the area of the polygon through the outermost of N x O nodes in the disc.
double disc_over_polygon(int n, int o);

}  // namespace risorius::muscle
