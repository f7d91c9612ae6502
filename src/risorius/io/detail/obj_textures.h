// SPDX-License-Identifier: MIT
/// \file
/// Finds the colour textures of an OBJ's materials in the MTL files that it names.
#pragma once

#include <filesystem>

#include "risorius/geom/polygon_mesh.h"
#include "risorius/io/detail/obj_reader.h"

namespace risorius::io::detail {

/// Assigns to faces the picture of their material's "map_Kd". MTL files that do not exist are ignored, as other programs do.
/// Whether the picture exists is not checked. Pictures that cannot be laid on are left out, with a note in `mesh`.
void add_obj_textures(const std::filesystem::path& obj, const ObjMaterials& materials,
                      geom::PolygonMesh& mesh);

}  // namespace risorius::io::detail
