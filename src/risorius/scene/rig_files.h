// SPDX-License-Identifier: MIT
/// \file
/// A rig file and the mesh that it names, both read and checked.
#pragma once

#include <filesystem>
#include <string>

#include "risorius/geom/mesh_checks.h"
#include "risorius/geom/polygon_mesh.h"
#include "risorius/rig/rig_description.h"

namespace risorius::scene {

struct RigFiles {
    std::filesystem::path file;
    rig::RigDescription rig;
    geom::PolygonMesh mesh;  ///< in the units of its file; rig::place_head applies metres_per_unit

    /// The name of the rig in messages.
    std::string place() const { return file.string(); }
};

/// Reads both files. Throws Error when the rig or its mesh cannot be used.
RigFiles read_rig_files(const std::filesystem::path& rig_file);

/// Checks the outer skin by geom::check_mesh(); other parts of the mesh need not be manifold. Throws Error; the message names the
/// mesh file, and ends with `advice` when geom::repair_mesh() can mend what is wrong.
geom::MeshReport check_skin(const rig::RigDescription& rig, const geom::PolygonMesh& mesh,
                            const std::string& advice = "");

}  // namespace risorius::scene
