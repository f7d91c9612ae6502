// SPDX-License-Identifier: MIT
// A page reads OBJ: the other formats need libraries and programs of the computer.
#include "risorius/core/error.h"
#include "risorius/io/detail/gltf_mesh.h"
#include "risorius/io/detail/import_process.h"

namespace risorius::io::detail {

geom::PolygonMesh read_gltf_mesh(const std::filesystem::path& file) {
    throw Error(file.string(), "an OBJ file: this page reads no other meshes", "another");
}
geom::PolygonMesh import_mesh(const std::filesystem::path& file, const std::function<bool()>&) {
    return read_gltf_mesh(file);
}

}  // namespace risorius::io::detail
