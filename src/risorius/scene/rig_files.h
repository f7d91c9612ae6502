// A rig together with the mesh it names, both checked.
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
    geom::PolygonMesh mesh;  ///< in its own units; rig::place_head applies metres_per_unit

    std::string place() const { return file.string(); }
};

/// Throws Error when the rig or its mesh cannot be used.
RigFiles read_rig_files(const std::filesystem::path& rig_file);

/// Checks the outer skin, which alone has to be a sound surface. Throws Error naming the mesh file.
geom::MeshReport check_skin(const rig::RigDescription& rig, const geom::PolygonMesh& mesh);

}  // namespace risorius::scene
