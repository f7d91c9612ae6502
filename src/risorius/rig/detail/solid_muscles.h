// SPDX-License-Identifier: MIT
/// \file
/// The muscles of a face that are simulated as volume-preserving solids, while the others are bundles of fibres; and their
/// material.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/rig/muscle_table.h"

namespace risorius::rig {

/// A muscle that is a solid. Field names are the keys of an entry of "solids" in a rig file.
struct SolidMuscle {
    std::string muscle;
    double strength = 1;  ///< force at activation 1 over the force in the muscle table   [0, 100]
    double width_m = 0;   ///< width of the belly at atlas size, m; 0: as in the muscle table
    /// Thickness of the belly at atlas size, m; 0: as in the muscle table
    double thickness_m = 0;
    /// Widths at origin and insertion over the width of the belly
    std::array<double, 2> ends{0.7, 0.7};
    /// Number of cells along, across and through the belly; 0: chosen by its size
    std::array<int, 3> cells{0, 0, 0};
    double shear_pa = 2000;  ///< shear modulus of the matrix                              [1, 1e9]
    double volume_pa = 1.5e6;  ///< bulk stiffness                                        [1, 1e10]
};

/// Reads an object: id of a muscle -> its entry, which may be empty. Throws Error for a muscle that is missing in the table or
/// has no path.
std::vector<SolidMuscle> read_solid_muscles(JsonCursor json, const MuscleTable& table);
Json solid_muscles_json(const std::vector<SolidMuscle>& solids);

}  // namespace risorius::rig
