// SPDX-License-Identifier: MIT
/// \file
/// Reads PLY files with strips of triangles, of which assimp loses triangles.
#pragma once

#include <filesystem>

#include "risorius/geom/polygon_mesh.h"

namespace risorius::import_mesh {

/// Whether the header of the file says that it has strips.
bool has_strips(const std::filesystem::path& file);

/// Reads vertices, faces and strips; an index below 0 begins the next strip. Text and both orders of bytes. Triangles in which a
/// vertex comes twice only join strips and are left out. Throws NoMesh and Error.
geom::PolygonMesh read_ply_with_strips(const std::filesystem::path& file);

}  // namespace risorius::import_mesh
