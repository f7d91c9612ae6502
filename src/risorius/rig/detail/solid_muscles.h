// SPDX-License-Identifier: MIT
/// \file
/// The muscles of a face that are simulated as volume-preserving solids, while the others are bundles of fibres; and their
/// material.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/types.h"
#include "risorius/io/tet_mesh.h"
#include "risorius/rig/muscle_table.h"

namespace risorius::rig {

/// The belly of a muscle as a mesh of tetrahedra.
struct SolidMesh {
    std::filesystem::path file;  ///< of the left side, or of a muscle that crosses the midline
    std::filesystem::path
        right_file;              ///< empty: the right side is the mirror image of the left one
    double metres_per_unit = 0;  ///< 0: that of the mesh of the rig
    /// Direction of all fibres, a unit vector; without it they are those of the file, or of a flow from origin to insertion
    std::optional<Vec3> along;
    /// How much of the length at origin and insertion is attached there, [0.01, 0.4]
    std::array<double, 2> ends{0.06, 0.06};
    std::shared_ptr<const io::TetMesh> left, right;  ///< as in the files; `right` may be null
};

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
    double shear_along_pa = 2000;  ///< the same along the fibres                  [shear_pa, 1e9]
    /// Addition to Young's modulus along stretched fibres, their passive curve included   [0, 1e9]
    double stretch_along_pa = 0;
    double volume_pa = 1.5e6;  ///< bulk stiffness                                        [1, 1e10]
    std::optional<SolidMesh> mesh;  ///< in place of a grid along the path

    bool is_stiffer_along() const { return shear_along_pa > shear_pa || stretch_along_pa > 0; }
};

/// Reads an object: id of a muscle -> its entry, which may be empty, and the meshes that it names. Throws Error for a muscle that is
/// missing in the table or has no path, and for a mesh that cannot be read.
std::vector<SolidMuscle> read_solid_muscles(JsonCursor json, const MuscleTable& table);
/// `name`: how a file of a mesh is named; without it, by its absolute path.
Json solid_muscles_json(const std::vector<SolidMuscle>& solids,
                        const std::function<std::string(const std::filesystem::path&)>& name = {});

}  // namespace risorius::rig
