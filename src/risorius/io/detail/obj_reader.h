// SPDX-License-Identifier: MIT
/// \file
/// Reads Wavefront OBJ and keeps its numbering: vertex i of the result is the i-th "v" of the file.
///
/// assimp splits an OBJ by object and material and gives every face corner its own vertex, so the index of the "v" line is
/// lost. Positions cannot restore it, because several vertices of a face may have the same position (a closed lid, a seam
/// between regions). Tables of displacements and lists of landmarks use that index. Therefore this format is read here.
#pragma once

#include <string>
#include <vector>

#include "risorius/geom/polygon_mesh.h"

namespace risorius::io::detail {

/// Materials of the faces by name. The material libraries are not read here.
struct ObjMaterials {
    std::vector<std::string> libraries;  ///< of "mtllib" lines, as written
    std::vector<std::string> names;
    std::vector<int> of_face;  ///< F; index into names; -1 before the first "usemtl"
};

/// Reads an OBJ. It understands v, vt, f, g, o and usemtl, relative indices and continued lines, and ignores other lines. A face
/// belongs to the last "g" or "o" before it ("default" before the first). In a file without either, it belongs to its material.
/// Throws Error; messages begin with `name`, and count lines and indices from 1 as the file does.
geom::PolygonMesh read_obj(const std::string& text, const std::string& name,
                           ObjMaterials* materials = nullptr);

}  // namespace risorius::io::detail
