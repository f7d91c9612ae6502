// SPDX-License-Identifier: MIT
/// \file
/// Selects nodes of a grid by planes, ranges and corners, in the form of experiment files. Ends and material coordinates select
/// the same part of a body at any resolution.
///
///   {"a3": "last"}                                  the plane of nodes where a3 is maximum
///   {"a1": [0, 1], "a2": -1}                        indices, both ends included; negative ones count from the end
///   {"a1": {"from": 0.4, "to": 0.6}}                material coordinates, 0..1
///   {"corners": [[0, 0], [1, 0]], "reach": 1}       corner nodes and the next `reach` nodes along each axis
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/tissue/solid_material.h"

namespace risorius::softbody {

/// A range along one axis, both ends included. `from` may be greater than `to`; then a graded change increases towards lower
/// coordinates.
struct AxisRange {
    bool coordinates = false;  ///< material coordinates instead of node indices
    double from = 0, to = 0;   ///< indices may be negative: -1 is the last node
    std::string place;         ///< the place in the file
};

/// The fields of a selection in a file.
struct NodeSelection {
    std::array<std::optional<AxisRange>, 3> axes;  ///< a node must lie in all given ranges
    std::vector<std::array<int, 3>> corners;  ///< each 0 or 1 per axis; used when no axis is given
    int reach = 0;  ///< number of nodes beside each corner, along each axis
};

/// Reads a selection. `axes` is the number of material axes of the body, 1 to 3. Throws Error for wrong values.
NodeSelection read_node_selection(const JsonCursor& json, int axes);

/// Returns the indices of the selected nodes, ascending. Throws Error for an index outside the grid; the message names its
/// place in the file.
std::vector<int> select(const NodeSelection& selection, const tissue::GridShape& grid);

/// Position of a selected node within the range of one axis: 0 at its `from`, 1 at its `to`. It is 1 when that axis is not
/// given or its range is a single plane.
double fraction_along(const NodeSelection& selection, const tissue::GridShape& grid, int axis,
                      int node);

}  // namespace risorius::softbody
