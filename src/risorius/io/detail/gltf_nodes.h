// SPDX-License-Identifier: MIT
/// \file
/// The meshes of a glTF file where its nodes put them at rest.
#pragma once

#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/io/detail/gltf_file.h"

namespace risorius::io::detail {

/// A mesh that a node shows.
struct PlacedMesh {
    std::size_t node = 0;
    JsonCursor mesh;
    /// Maps its vertices to the units of the file. A node with a skin lies where its joints are, wherever the node is.
    Eigen::Matrix4d place;
};

/// In the order of the nodes. Throws Error for a node inside of itself.
std::vector<PlacedMesh> placed_meshes(const GltfFile& from);

/// Whether a mesh is worn on the head that others are: none of its primitives has numbers of vertices.
bool is_worn(const std::vector<JsonCursor>& primitives);

}  // namespace risorius::io::detail
