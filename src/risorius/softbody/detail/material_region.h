// SPDX-License-Identifier: MIT
/// \file
/// A region: a part of a body with a different material. It is a selection of nodes, with the quantities that are multiplied or
/// replaced there. The change is uniform or grows along one axis.
///
///   {"nodes": {"a1": {"from": 0.5, "to": 1}}, "factors": {"elastic": {"22": 0.1, "23": 0.1}, "damping": 0.5}}
///   {"nodes": {"a2": {"from": 0.46, "to": 1}}, "values": {"elastic_n_per_m3": 0.5}, "graded": "a2"}
#pragma once

#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/types.h"
#include "risorius/softbody/detail/node_selection.h"
#include "risorius/tissue/solid_material.h"

namespace risorius::softbody {

/// A number or tensor of a material that regions may change.
struct Quantity {
    std::string_view name;  ///< in "factors": "elastic"
    std::string_view key;   ///< in "values", with its unit: "elastic_n_per_m3"
    int axes = 0;           ///< 0 for a number, else the rows of the tensor
};

/// A change of one quantity in a region.
struct MaterialChange {
    std::string quantity;  ///< Quantity::name
    bool factor = true;    ///< true: multiplies the value; false: replaces it
    Mat3 number = Mat3::Ones();
    /// 1 for the entries of `number` that are given in the file, 0 for the others; all 1 for a plain number.
    Mat3 given = Mat3::Zero();
};

/// The fields of a region in a file.
struct MaterialRegion {
    NodeSelection nodes;
    std::vector<MaterialChange> changes;
    /// The change increases linearly along this axis, from none at `from` to the whole change at `to`; -1: uniform.
    int graded_axis = -1;
};

/// Reads the list "regions". `axes` is the number of material axes of the body. Throws Error for wrong values.
std::vector<MaterialRegion> read_regions(const JsonCursor& json,
                                         const std::vector<Quantity>& quantities, int axes);

/// Reads a non-negative number for an isotropic tensor, or {"11": .., "22": .., "12": ..}, with `axes` rows. An off-diagonal
/// entry that is left out is the mean of the two diagonal entries, as in eq. (10) of the thesis (solid_material.h). Throws
/// Error for wrong values.
Mat3 read_tensor(const JsonCursor& json, int axes);

/// Calls `change` for every node of every region, in order, with the fraction 0..1 of the change that applies.
void for_each_change(
    const std::vector<MaterialRegion>& regions, const tissue::GridShape& grid,
    const std::function<void(int node, const MaterialChange& change, double fraction)>& change);

/// Returns the value `before` after a fraction (0..1) of the change.
Mat3 changed(const Mat3& before, const MaterialChange& change, double fraction);
double changed(double before, const MaterialChange& change, double fraction);

}  // namespace risorius::softbody
