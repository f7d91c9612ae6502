// SPDX-License-Identifier: MIT
/// \file
/// Reads the meshes of a glTF file as one polygon mesh. See io/read_mesh.h for order, groups and units.
#pragma once

#include <filesystem>

#include "risorius/core/json_cursor.h"
#include "risorius/geom/polygon_mesh.h"

namespace risorius::io::detail {

/// Throws Error when the file is not glTF or has no faces.
geom::PolygonMesh read_gltf_mesh(const std::filesystem::path& file);

/// The transform of a node relative to its parent, from its matrix or from translation, rotation and scale.
Eigen::Matrix4d transform_of(const JsonCursor& node);

}  // namespace risorius::io::detail
