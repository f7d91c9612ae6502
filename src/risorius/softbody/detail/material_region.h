// SPDX-License-Identifier: MIT
/// \file
/// Parts of a body whose material differs: a selection of nodes and what is multiplied or set there, in full or growing
/// along one axis.
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
    int axes = 0;           ///< 0 for a number, otherwise rows of the tensor
};

struct MaterialChange {
    std::string quantity;  ///< Quantity::name
    bool factor = true;    ///< multiplies; otherwise takes the value's place
    Mat3 number = Mat3::Ones();
    Mat3 given = Mat3::Zero();  ///< 1 where `number` counts; a plain number counts everywhere
};

struct MaterialRegion {
    NodeSelection nodes;
    std::vector<MaterialChange> changes;
    int graded_axis =
        -1;  ///< the change grows linearly from nothing at `from` to all of it at `to`
};

std::vector<MaterialRegion> read_regions(const JsonCursor& json,
                                         const std::vector<Quantity>& quantities, int axes);

/// A non-negative number for an isotropic tensor, or {"11": .., "22": .., "12": ..}; off-diagonals left out are the mean
/// of their diagonals, as in eq. (10). `axes` rows.
Mat3 read_tensor(const JsonCursor& json, int axes);

/// Calls `change` for every node of every region, in order, with the share 0..1 of the change it gets.
void for_each_change(
    const std::vector<MaterialRegion>& regions, const tissue::GridShape& grid,
    const std::function<void(int node, const MaterialChange& change, double fraction)>& change);

/// `before` with `share` of the change.
Mat3 changed(const Mat3& before, const MaterialChange& change, double fraction);
double changed(double before, const MaterialChange& change, double fraction);

}  // namespace risorius::softbody
