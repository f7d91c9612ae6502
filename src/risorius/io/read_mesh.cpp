// SPDX-License-Identifier: MIT
#include "risorius/io/read_mesh.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <sstream>

#include "risorius/core/error.h"
#include "risorius/core/json_cursor.h"
#include "risorius/io/detail/obj_reader.h"
#include "risorius/io/detail/obj_textures.h"
#include "risorius/io/detail/scene_reader.h"

namespace risorius::io {
namespace {

std::string lower_case_ending(const std::filesystem::path& file) {
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending;
}

std::string read_text(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    if (!in) throw Error(file.string(), "a readable file", "one that cannot be read");
    return std::move(text).str();
}

void require_finite(const geom::PolygonMesh& mesh, const std::string& name) {
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const auto p = mesh.positions.row(v);
        if (p.allFinite()) continue;
        std::ostringstream found;
        found << "(" << p(0) << ", " << p(1) << ", " << p(2) << ") at vertex " << v
              << " (counted from 0)";
        throw Error(name, "finite positions", found.str());
    }
}

}  // namespace

geom::PolygonMesh read_mesh(const std::filesystem::path& file, const MeshReadOptions& options) {
    const std::string name = file.string();
    if (!(options.metres_per_unit > 0) || !std::isfinite(options.metres_per_unit))
        throw Error(name, "metres_per_unit in (0, inf)", format_number(options.metres_per_unit));
    if (!std::filesystem::exists(file)) throw Error(name, "a mesh file", "no such file");
    if (!std::filesystem::is_regular_file(file))
        throw Error(name, "a mesh file", "a folder or device");
    if (std::filesystem::file_size(file) == 0) throw Error(name, "a mesh file", "an empty file");

    const std::string ending = lower_case_ending(file);
    geom::PolygonMesh mesh;
    if (ending == ".obj") {
        detail::ObjMaterials materials;
        mesh = detail::read_obj(read_text(file), name, &materials);
        detail::add_obj_textures(file, materials, mesh);
    } else {
        const bool keeps_order = ending == ".glb" || ending == ".gltf" || ending == ".ply";
        mesh = detail::read_scene(file, keeps_order);
    }
    require_finite(mesh, name);
    mesh.positions *= options.metres_per_unit;
    return mesh;
}

}  // namespace risorius::io
