// SPDX-License-Identifier: MIT
// Writes Wavefront OBJ: groups, polygons of any size and texture coordinates, in the order of the mesh.
#include <array>
#include <map>
#include <string>
#include <system_error>
#include <vector>

#include "risorius/core/error.h"
#include "risorius/core/json_cursor.h"
#include "risorius/core/output_set.h"
#include "risorius/io/read_mesh.h"

namespace risorius::io {
namespace {

std::string obj_text(const geom::PolygonMesh& mesh, double metres_per_unit) {
    std::string out;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        out += 'v';
        for (int k = 0; k < 3; ++k)
            (out += ' ') += format_number(mesh.positions(v, k) / metres_per_unit);
        out += '\n';
    }

    // Equal texture coordinates are written once.
    std::vector<int> texcoord_of_corner;
    if (mesh.corner_texcoord.rows() > 0) {
        std::map<std::array<double, 2>, int> index;
        for (long c = 0; c < mesh.corner_texcoord.rows(); ++c) {
            const std::array<double, 2> t{mesh.corner_texcoord(c, 0), mesh.corner_texcoord(c, 1)};
            const auto [entry, is_new] = index.try_emplace(t, static_cast<int>(index.size()));
            texcoord_of_corner.push_back(entry->second);
            if (!is_new) continue;
            (out += "vt ") += format_number(t[0]);
            (out += ' ') += format_number(t[1]);
            out += '\n';
        }
    }

    int group = -1;
    for (int f = 0; f < mesh.face_count(); ++f) {
        if (mesh.face_group[f] != group) {
            group = mesh.face_group[f];
            (out += "g ") += mesh.group_names[group];
            out += '\n';
        }
        out += 'f';
        for (int c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c) {
            (out += ' ') += std::to_string(mesh.corner_vertex[c] + 1);
            if (!texcoord_of_corner.empty())
                (out += '/') += std::to_string(texcoord_of_corner[c] + 1);
        }
        out += '\n';
    }
    return out;
}

}  // namespace

void write_obj(const geom::PolygonMesh& mesh, const std::filesystem::path& file,
               double metres_per_unit) {
    write_file(file, obj_text(mesh, metres_per_unit));
}

}  // namespace risorius::io
