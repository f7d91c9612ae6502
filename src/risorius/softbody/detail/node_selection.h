// SPDX-License-Identifier: MIT
/// \file
/// Nodes of a grid picked by planes, ranges and corners, as experiment files write them. The same words pick the same part
/// of a body at any resolution when they are ends or material coordinates.
///
///   {"a3": "last"}                                  the plane of nodes where a3 is greatest
///   {"a1": [0, 1], "a2": -1}                        indices, both ends included; negative ones count from the end
///   {"a1": {"from": 0.4, "to": 0.6}}                material coordinates, 0..1
///   {"corners": [[0, 0], [1, 0]], "reach": 1}       corner nodes and their next `reach` nodes along each axis
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/tissue/solid_material.h"

namespace risorius::softbody {

/// A stretch of one axis, both ends included. `from` may lie after `to`: grading follows the order written.
struct AxisRange {
    bool coordinates = false;  ///< material coordinates instead of node indices
    double from = 0, to = 0;   ///< indices may be negative: -1 is the last node
    std::string place;         ///< where it was written
};

struct NodeSelection {
    std::array<std::optional<AxisRange>, 3> axes;  ///< a node has to lie in all that are given
    std::vector<std::array<int, 3>> corners;  ///< each 0 or 1 per axis; used when no axis is given
    int reach = 0;                            ///< nodes beside each corner, along each axis
};

/// `axes`: how many material axes the body has, 1 to 3.
NodeSelection read_node_selection(const JsonCursor& json, int axes);

/// Rows of the selected nodes, ascending. Throws Error with the place of an index the grid does not have.
std::vector<int> select(const NodeSelection& selection, const tissue::GridShape& grid);

/// Where a selected node lies within the range of one axis: 0 at its `from`, 1 at its `to`; 1 when that axis is not given
/// or its range is a single plane.
double fraction_along(const NodeSelection& selection, const tissue::GridShape& grid, int axis,
                      int node);

}  // namespace risorius::softbody
