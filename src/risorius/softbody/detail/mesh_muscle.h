// SPDX-License-Identifier: MIT
/// \file
/// A muscle whose belly is a region of a mesh of tetrahedra: the key "muscle" of a material of mesh_body.h.
///
///   "muscle": {"tension_pa": 300000, "optimal_stretch": 1, "curves": "zajac",
///              "fibres": {"from": {"low_m": [..], "high_m": [..]}, "to": {"low_m": [..], "high_m": [..]}}}
///
/// - "tension_pa", "optimal_stretch", "greatest_speed_hz", "damping" and "curves" are those of muscle/fibre_tets.h.
/// - "fibres": {"along": [1, 0, 0]}, the same direction everywhere; or two boxes with nodes of origin and insertion, between which the
///   directions are computed (muscle/fibre_flow.h). Without the key, they are the field of the file (io/tet_mesh.h).
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "risorius/core/json_cursor.h"
#include "risorius/io/tet_mesh.h"
#include "risorius/muscle/fibre_tets.h"

namespace risorius::softbody {

/// A box along the axes.
struct Box {
    Vec3 low_m, high_m;
    bool holds(const Vec3& at) const {
        return (at.array() >= low_m.array()).all() && (at.array() <= high_m.array()).all();
    }
};
/// Reads "low_m" and "high_m".
Box read_box(const JsonCursor& json);

/// The fields of a muscle in a file.
struct MeshMuscle {
    std::string place;
    muscle::FibreTetsParameters parameters;
    std::optional<Vec3> along;                ///< a unit vector
    std::optional<std::pair<Box, Box>> ends;  ///< origin and insertion
};

/// Throws Error.
MeshMuscle read_mesh_muscle(const JsonCursor& json);

/// The directions of the fibres of some tetrahedra of a mesh, unit vectors. `mesh` is in m. Throws Error when there are none, and when a
/// box holds no node of the muscle or the boxes share one.
Points fibre_directions(const MeshMuscle& muscle, const io::TetMesh& mesh,
                        const std::vector<int>& tets);

}  // namespace risorius::softbody
