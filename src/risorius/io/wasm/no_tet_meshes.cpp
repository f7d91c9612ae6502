// SPDX-License-Identifier: MIT
// In a page: a rig whose muscles are meshes of tetrahedra is for a computer.
#include "risorius/core/error.h"
#include "risorius/io/tet_mesh.h"

namespace risorius::io {

TetMesh read_tet_mesh(const std::filesystem::path& file) {
    throw Error(file.string(), "a rig without meshes of muscles, since this is a page",
                "a mesh of tetrahedra");
}

}  // namespace risorius::io
