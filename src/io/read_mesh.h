// Face meshes from files (assimp): OBJ, PLY, glTF/GLB, FBX, COLLADA and what else assimp reads.
//
// Vertices keep the order of the file (OBJ, glTF), quads stay quads, groups and objects keep their names.
#pragma once

#include <filesystem>

#include "geom/polygon_mesh.h"

namespace risorius::io {

/// Positions are multiplied by `metres_per_unit`.
struct MeshReadOptions {
    double metres_per_unit = 1.0;
};

/// Throws Error on a missing, unreadable, empty or non-finite mesh.
geom::PolygonMesh read_mesh(const std::filesystem::path& file, const MeshReadOptions& options = {});

/// Wavefront OBJ with groups; positions are divided by `metres_per_unit`. Written beside and renamed, never half.
void write_obj(const geom::PolygonMesh& mesh, const std::filesystem::path& file, double metres_per_unit = 1.0);

}  // namespace risorius::io
