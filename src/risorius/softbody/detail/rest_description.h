// SPDX-License-Identifier: MIT
/// \file
/// The undeformed shape of a body as written: a block, a cylinder, a sheet, a tube, or every node by itself.
///
///   {"block_m": [3, 3, 3]}                              solid; edges along x, y, z, which are a1, a2, a3
///   {"cylinder": {"radius_m": 0.5, "length_m": 3}}      solid; its axis is a1 and x, a square of a2, a3 pressed into the disc
///   {"sheet_m": [3, 3]}                                 surface; edges along x, y, which are a1, a2
///   {"path_m": [[0, 0, 0], [3, 0, 0]]}                  curve; straight from point to point, nodes evenly along it
///   {"tube": {"radius_m": 0.5, "length_m": 3}}          cylinder; its axis is a1 and x, a2 goes round from y towards z
///   {"points_m": [[0, 0, 0], ...]}                      any; node [m, n, o] in row (m N + n) O + o; holds for one grid only
///
/// each with "turn": {"axis": [0, 1, 0], "angle_deg": 90} about the shape's own origin and then "at_m": [0, 0, 1].
#pragma once

#include <string>

#include "risorius/core/json_cursor.h"
#include "risorius/core/types.h"
#include "risorius/tissue/solid_material.h"

namespace risorius::softbody {

enum class Kind {
    kSolid,     ///< a grid over three material axes
    kSurface,   ///< over two
    kCylinder,  ///< a surface closed along a2
    kCurve      ///< over one
};

struct RestDescription {
    enum class Form { kBlock, kCylinder, kSheet, kTube, kPath, kPoints };
    Form form = Form::kBlock;
    std::string place;      ///< where it was written
    Vec3 edges_m{1, 1, 1};  ///< of a block; of a sheet the first two
    double radius_m = 1, length_m = 1;
    Points points_m;  ///< of a path its corners, else every node
    Rigid placed = Rigid::Identity();
};

/// The form has to be one of the kind's.
RestDescription read_rest(const JsonCursor& json, Kind kind);

/// Every node of a grid (one layer thick for surfaces). Throws Error for points that are not one per node.
Points rest_points(const RestDescription& rest, const tissue::GridShape& grid);

}  // namespace risorius::softbody
