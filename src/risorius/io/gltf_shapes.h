// SPDX-License-Identifier: MIT
/// \file
/// Reads the blend shapes of any glTF 2.0 file, with its meshes and primitives put together. Targets may be dense, sparse or
/// quantised, nodes may have transforms, and pictures are passed over.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "risorius/io/morph_model.h"

namespace risorius::io {

/// The vertices of all meshes of a file, and what its shapes do to them. Seams and parts repeat vertices.
struct GltfShapes {
    bool by_risorius = false;  ///< `risorius shapes` wrote it, see read_glb()
    Points positions;          ///< V x 3, in the units of the file, placed by their nodes
    std::vector<int> vertex;   ///< V, the attribute _VERTEX; empty unless all primitives have it
    std::vector<MorphTarget>
        targets;  ///< shapes of one name on several meshes are one; `vertex` are rows of `positions`
};

/// Throws Error for a file without named shapes.
GltfShapes read_gltf_shapes(const std::filesystem::path& file);

}  // namespace risorius::io
