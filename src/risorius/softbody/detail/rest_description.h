// SPDX-License-Identifier: MIT
/// \file
/// The rest shape of a body as a file describes it: a block, a cylinder, a sheet, a tube, a path, or a list of all nodes.
///
///   {"block_m": [3, 3, 3]}                              solid; edges along x, y, z, which are a1, a2, a3
///   {"cylinder": {"radius_m": 0.5, "length_m": 3}}      solid; its axis is a1 and x; the square of a2, a3 is mapped to a disc
///   {"sheet_m": [3, 3]}                                 surface; edges along x, y, which are a1, a2
///   {"path_m": [[0, 0, 0], [3, 0, 0]]}                  curve; straight from point to point, with evenly spaced nodes
///   {"tube": {"radius_m": 0.5, "length_m": 3}}          cylinder; its axis is a1 and x, a2 goes round from y towards z
///   {"points_m": [[0, 0, 0], ...]}                      any; node [m, n, o] is row (m N + n) O + o; for one grid only
///
/// Each may have "turn": {"axis": [0, 1, 0], "angle_deg": 90}, a rotation about the shape's own origin, and then
/// "at_m": [0, 0, 1], a translation.
#pragma once

#include <string>

#include "risorius/core/json_cursor.h"
#include "risorius/core/types.h"
#include "risorius/tissue/solid_material.h"

namespace risorius::softbody {

/// The kind of a body, which gives the number of its material axes.
enum class Kind {
    kSolid,     ///< a grid over three material axes
    kSurface,   ///< a grid over two material axes
    kCylinder,  ///< a surface closed along a2
    kCurve      ///< a grid over one material axis
};

/// The fields of a rest shape in a file.
struct RestDescription {
    enum class Form { kBlock, kCylinder, kSheet, kTube, kPath, kPoints };
    Form form = Form::kBlock;
    std::string place;      ///< the place in the file
    Vec3 edges_m{1, 1, 1};  ///< of a block; the first two of a sheet
    double radius_m = 1, length_m = 1;
    Points points_m;  ///< corners of a path, or all nodes
    Rigid placed = Rigid::Identity();
};

/// Reads a rest shape. Throws Error when the form is not for bodies of this kind.
RestDescription read_rest(const JsonCursor& json, Kind kind);

/// All nodes of a grid, N x 3, m (one layer for surfaces). Throws Error when the number of points in the file is not the number
/// of nodes.
Points rest_points(const RestDescription& rest, const tissue::GridShape& grid);

}  // namespace risorius::softbody
