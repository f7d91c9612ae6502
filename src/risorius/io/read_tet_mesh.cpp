// SPDX-License-Identifier: MIT
// The reader of tetrahedral meshes: which format a file has.
#include <string>

#include "risorius/core/error.h"
#include "risorius/core/read_file.h"
#include "risorius/io/detail/mesh_limits.h"
#include "risorius/io/detail/tet_mesh_builder.h"
#include "risorius/io/tet_mesh.h"

namespace risorius::io {

TetMesh read_tet_mesh(const std::filesystem::path& file) {
    const std::string ending = file.extension().string(), name = file.string();
    if (ending == ".node" || ending == ".ele") {
        std::filesystem::path nodes = file, tets = file;
        nodes.replace_extension(".node");
        tets.replace_extension(".ele");
        return detail::read_tetgen(read_file(nodes, detail::kMeshFile), nodes.string(),
                                   read_file(tets, detail::kMeshFile), tets.string());
    }
    using Reader = TetMesh (*)(std::string_view, const std::string&);
    const Reader reader = ending == ".msh"     ? detail::read_msh
                          : ending == ".vtk"   ? detail::read_legacy_vtk
                          : ending == ".vtu"   ? detail::read_vtu
                          : ending == ".mesh"  ? detail::read_medit
                          : ending == ".meshb" ? detail::read_meditb
                                               : nullptr;
    if (reader == nullptr)
        throw Error(name, "an ending of .msh, .vtk, .vtu, .mesh, .meshb, .node or .ele",
                    "\"" + ending + "\"");
    return reader(read_file(file, detail::kMeshFile), name);
}

}  // namespace risorius::io
