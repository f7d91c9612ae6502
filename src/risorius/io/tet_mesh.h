// SPDX-License-Identifier: MIT
/// \file
/// Reads tetrahedral meshes: Gmsh .msh (2 and 4.1, text and binary), VTK .vtk (legacy, text and binary) and .vtu (text, base64 and raw
/// blocks, also packed by zlib), Medit .mesh (text) and .meshb (binary), TetGen .node with .ele.
///
/// Only linear tetrahedra are read; other elements are left out, and so are nodes that no tetrahedron has. Each tetrahedron has a tag:
///
///   .msh          the physical group, or the entity where it is in none
///   .vtk, .vtu    the cell data named "tag", "region", "material", "gmsh:physical", "CellEntityIds" or "medit:ref"; 0 without them
///   .mesh, .ele   the reference; the attribute
///
/// Files of VTK and Gmsh may have a field of directions of fibres: cell or point data (Gmsh: $ElementData) with three components, named
/// "fibre", "fiber", "fibres", "fibers", "fibre_direction" or "fiber_direction". Those of points are averaged over the corners of each
/// tetrahedron, without regard to their sign.
///
/// Tetrahedra that are all turned the other way, as TetGen has them, are turned over. One of another orientation than the rest, or without
/// volume, is an error.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::io {

struct TetMesh {
    Points positions;                  ///< V x 3, in the units of the file
    Tets tets;                         ///< T x 4, positive volumes
    std::vector<int> tags;             ///< of each tetrahedron
    std::map<std::string, int> names;  ///< of tags, where the file has them
    Points fibres =
        Points(0, 3);  ///< T x 3, of any length, also 0; without rows when the file has none
};

/// Throws Error for a mesh that is missing, unreadable, too large, empty or not finite. `file`: for TetGen either of its two files.
TetMesh read_tet_mesh(const std::filesystem::path& file);

}  // namespace risorius::io
