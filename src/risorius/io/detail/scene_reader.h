// SPDX-License-Identifier: MIT
/// \file
/// Converts the result of assimp to one polygon mesh in metres. See io/read_mesh.h for order, groups and units.
#pragma once

#include <filesystem>

#include "risorius/geom/polygon_mesh.h"

namespace risorius::io::detail {

/// Throws Error when assimp cannot read the file or finds no faces in it.
geom::PolygonMesh read_scene(const std::filesystem::path& file, bool keep_vertices);

}  // namespace risorius::io::detail
