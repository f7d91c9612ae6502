// SPDX-License-Identifier: MIT
/// \file
/// Reads face meshes from files with assimp: OBJ, PLY, STL, glTF/GLB, FBX, COLLADA and other formats.
///
/// Vertices keep the order of the file (OBJ, PLY, glTF), polygons stay polygons, and groups and objects keep their names.
///
///   OBJ          groups are the "g" or "o" names, or the materials where there are neither
///   glTF, PLY    vertices in file order, mesh after mesh; glTF has only triangles
///   FBX, DAE,    assimp gives face corners without the file's indices: corners of one node at exactly
///   STL, ...     the same position become one vertex, in the order of first use; one group per node
///                with a mesh, named after it, or "node.material" where a node has several; node
///                transforms are applied
///   textures     the colour pictures of materials: "map_Kd" of MTL files, base colour of glTF,
///                diffuse colour elsewhere; files next to the mesh or inside it
///   units        the unit stated in FBX and COLLADA files is applied, which gives metres; then
///                `metres_per_unit` multiplies
///   texture      v is up, as in OBJ (glTF's v is flipped)
#pragma once

#include <filesystem>
#include <functional>

#include "risorius/geom/polygon_mesh.h"

namespace risorius::io {

/// Reads a mesh. Positions are multiplied by `metres_per_unit`, for example 0.01 for a head in centimetres. FBX and COLLADA state
/// their unit themselves and need 1, unless they state it wrongly.
struct MeshReadOptions {
    double metres_per_unit = 1.0;
    /// Returns true when reading should stop; then Interrupted is thrown. It is asked while other programs work.
    std::function<bool()> stopped{};
};

/// Throws Error for a mesh that is missing, unreadable, empty or not finite. Vertices in messages count from 0. But messages
/// about a line of an OBJ file ("head.obj:12") count from 1, as the file does.
geom::PolygonMesh read_mesh(const std::filesystem::path& file, const MeshReadOptions& options = {});

/// Writes Wavefront OBJ with groups. Positions are divided by `metres_per_unit`. The file is written under a temporary name and
/// then renamed. Throws RunError when it cannot be written.
void write_obj(const geom::PolygonMesh& mesh, const std::filesystem::path& file,
               double metres_per_unit = 1.0);

}  // namespace risorius::io
