// Which muscles of a face are volume-preserving solids rather than bundles of fibres, and what they are made of.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/rig/muscle_table.h"

namespace risorius::rig {

/// Field names are the keys of an entry of "solids" in a rig file.
struct SolidMuscle {
    std::string muscle;
    double strength = 1;     ///< force at activation 1 / force of the muscle table   [0, 100]
    double width_m = 0;      ///< of the belly, atlas size; the muscle table's unless given
    double thickness_m = 0;  ///< likewise
    std::array<double, 2> ends{0.7, 0.7};  ///< width at origin and insertion / width of the belly
    std::array<int, 3> cells{0, 0, 0};     ///< along, across, through; 0: by its size
    double shear_pa = 2000;    ///< of the muscle's matrix                              [1, 1e9]
    double volume_pa = 1.5e6;  ///< against changes of volume                           [1, 1e10]
};

/// An object: id of a muscle -> its entry, which may be empty. Throws Error for a muscle that the table does not have
/// or that has no path.
std::vector<SolidMuscle> read_solid_muscles(JsonCursor json, const MuscleTable& table);
Json solid_muscles_json(const std::vector<SolidMuscle>& solids);

}  // namespace risorius::rig
