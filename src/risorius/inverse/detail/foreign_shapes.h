// SPDX-License-Identifier: MIT
/// \file
/// Blend shapes of any glTF file on the vertices of a rig's mesh. The vertices of the file are found by their number (_VERTEX), by
/// their order, or by their position at rest, in metres, centimetres, millimetres or the unit of the rig's mesh.
#pragma once

#include <string>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/io/gltf_shapes.h"
#include "risorius/rig/head.h"

namespace risorius::inverse {

struct ForeignShapes {
    std::vector<Points> fields;  ///< one for each target of the file; V x 3, m, head frame
    std::vector<char> known;     ///< V; whether the file has the vertex
    std::string how;             ///< "by position: 20912 of 21000 vertices"
};

/// Throws Error at `place` when fewer than half of the vertices are found.
ForeignShapes place_foreign_shapes(const io::GltfShapes& shapes, const rig::Head& head,
                                   const std::string& place);

}  // namespace risorius::inverse
