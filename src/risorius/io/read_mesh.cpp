// SPDX-License-Identifier: MIT
#include "risorius/io/read_mesh.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <new>
#include <sstream>

#include "risorius/core/error.h"
#include "risorius/core/json_cursor.h"
#include "risorius/core/text_lines.h"
#include "risorius/io/detail/gltf_mesh.h"
#include "risorius/io/detail/import_process.h"
#include "risorius/io/detail/mesh_limits.h"
#include "risorius/io/detail/obj_reader.h"
#include "risorius/io/detail/obj_textures.h"

namespace risorius::io {
namespace {

std::string lower_case_ending(const std::filesystem::path& file) {
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending;
}

// Farther out, a head would be a thousandth of a micrometre or larger than the Earth in any unit.
constexpr double kFarthest = 1e9;

void require_finite(const geom::PolygonMesh& mesh, const std::string& name) {
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const auto p = mesh.positions.row(v);
        const bool finite = p.allFinite();
        if (finite && p.cwiseAbs().maxCoeff() <= kFarthest) continue;
        std::ostringstream found;
        found << "(" << p(0) << ", " << p(1) << ", " << p(2) << ") at vertex " << v
              << " (counted from 0)";
        throw Error(name, finite ? "coordinates of at most 1e9" : "finite positions", found.str());
    }
}

geom::PolygonMesh read_by_ending(const std::filesystem::path& file,
                                 const MeshReadOptions& options) {
    const std::string ending = lower_case_ending(file);
    if (ending == ".obj") {
        detail::ObjMaterials materials;
        geom::PolygonMesh mesh =
            detail::read_obj(read_text(file, detail::kMeshFile), file.string(), &materials);
        detail::add_obj_textures(file, materials, mesh);
        return mesh;
    }
    if (ending == ".glb" || ending == ".gltf" || ending == ".vrm")
        return detail::read_gltf_mesh(file);
    return detail::import_mesh(file, options.stopped);
}

}  // namespace

geom::PolygonMesh read_mesh(const std::filesystem::path& file, const MeshReadOptions& options) {
    const std::string name = file.string();
    if (!(options.metres_per_unit > 0) || !std::isfinite(options.metres_per_unit))
        throw Error(name, "metres_per_unit in (0, inf)", format_number(options.metres_per_unit));
    check_file(file, detail::kMeshFile);
    if (std::filesystem::file_size(file) == 0) throw Error(name, "a mesh file", "an empty file");

    geom::PolygonMesh mesh;
    try {
        mesh = read_by_ending(file, options);
    } catch (const std::bad_alloc&) {
        throw Error(name, "a mesh that fits into memory", "a larger one");
    }
    require_finite(mesh, name);
    mesh.positions *= options.metres_per_unit;
    mesh.from_file.topRows<3>() *= options.metres_per_unit;
    return mesh;
}

}  // namespace risorius::io
