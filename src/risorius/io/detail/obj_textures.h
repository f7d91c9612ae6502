// Colour pictures of an OBJ's materials, from the MTL files that it names.
#pragma once

#include <filesystem>

#include "risorius/geom/polygon_mesh.h"
#include "risorius/io/detail/obj_reader.h"

namespace risorius::io::detail {

/// Gives the faces of materials with a "map_Kd" its picture. An MTL file that is not there is passed over, as by other
/// programs; a picture is only looked for by who wants it. Throws Error for a "map_Kd" that cannot be followed.
void add_obj_textures(const std::filesystem::path& obj, const ObjMaterials& materials,
                      geom::PolygonMesh& mesh);

}  // namespace risorius::io::detail
