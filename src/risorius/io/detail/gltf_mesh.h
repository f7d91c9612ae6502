// SPDX-License-Identifier: MIT
/// \file
/// Reads the meshes of a glTF file as one polygon mesh. See io/read_mesh.h for order, groups and units.
#pragma once

#include <filesystem>

#include "risorius/geom/polygon_mesh.h"

namespace risorius::io::detail {

/// Throws Error when the file is not glTF or has no faces.
geom::PolygonMesh read_gltf_mesh(const std::filesystem::path& file);

}  // namespace risorius::io::detail
