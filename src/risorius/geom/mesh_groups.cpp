// SPDX-License-Identifier: MIT
#include "risorius/geom/mesh_groups.h"

#include <algorithm>
#include <map>

namespace risorius::geom {

void drop_empty_groups(PolygonMesh& mesh) {
    std::vector<bool> used(mesh.group_names.size(), false);
    for (const int group : mesh.face_group) used[static_cast<std::size_t>(group)] = true;
    std::vector<int> number;
    std::vector<std::string> names;
    for (std::size_t g = 0; g < used.size(); ++g) {
        number.push_back(static_cast<int>(names.size()));
        if (used[g]) names.push_back(std::move(mesh.group_names[g]));
    }
    for (int& group : mesh.face_group) group = number[static_cast<std::size_t>(group)];
    mesh.group_names = std::move(names);
}

void split_by_material(PolygonMesh& mesh, int group) {
    if (mesh.face_material.empty()) return;
    const std::string name = mesh.group_names[static_cast<std::size_t>(group)];
    std::map<int, int> group_of_material;
    for (std::size_t f = 0; f < mesh.face_group.size(); ++f) {
        const int material = mesh.face_material[f];
        if (mesh.face_group[f] != group || material < 0) continue;
        const auto [entry, is_new] =
            group_of_material.try_emplace(material, static_cast<int>(mesh.group_names.size()));
        if (is_new) {
            const std::string whole =
                name + "." + mesh.material_names[static_cast<std::size_t>(material)];
            const int known = mesh.group_index(whole);
            if (known >= 0)
                entry->second = known;
            else
                mesh.group_names.push_back(whole);
        }
        mesh.face_group[f] = entry->second;
    }
    drop_empty_groups(mesh);
}

void split_as_named(PolygonMesh& mesh, const std::vector<std::string>& names) {
    if (mesh.face_material.empty()) return;
    for (const std::string& name : names) {
        if (mesh.group_index(name) >= 0) continue;
        const auto materials = materials_of_groups(mesh);
        for (std::size_t g = 0; g < materials.size(); ++g) {
            const bool is_inside = std::any_of(
                materials[g].begin(), materials[g].end(),
                [&](const auto& material) { return mesh.group_names[g] + "." + material == name; });
            if (!is_inside) continue;
            split_by_material(mesh, static_cast<int>(g));
            break;
        }
    }
}

std::vector<std::vector<std::string>> materials_of_groups(const PolygonMesh& mesh) {
    std::vector<std::vector<std::string>> out(mesh.group_names.size());
    if (mesh.face_material.empty()) return out;
    std::map<std::pair<int, int>, bool> seen;
    for (std::size_t f = 0; f < mesh.face_group.size(); ++f) {
        const int group = mesh.face_group[f], material = mesh.face_material[f];
        if (material < 0 || !seen.try_emplace({group, material}, true).second) continue;
        out[static_cast<std::size_t>(group)].push_back(
            mesh.material_names[static_cast<std::size_t>(material)]);
    }
    return out;
}

void keep_faces(PolygonMesh& mesh, const std::vector<bool>& kept) {
    const PolygonMesh old = mesh;
    mesh.face_begin = {0};
    mesh.corner_vertex.clear();
    mesh.face_group.clear();
    mesh.face_texture.clear();
    mesh.face_material.clear();
    std::vector<int> corners;
    for (int face = 0; face < old.face_count(); ++face) {
        const auto f = static_cast<std::size_t>(face);
        if (!kept[f]) continue;
        for (int c = old.face_begin[f]; c < old.face_begin[f + 1]; ++c) {
            mesh.corner_vertex.push_back(old.corner_vertex[static_cast<std::size_t>(c)]);
            corners.push_back(c);
        }
        mesh.face_begin.push_back(static_cast<int>(mesh.corner_vertex.size()));
        mesh.face_group.push_back(old.face_group[f]);
        if (!old.face_texture.empty()) mesh.face_texture.push_back(old.face_texture[f]);
        if (!old.face_material.empty()) mesh.face_material.push_back(old.face_material[f]);
    }
    if (old.corner_texcoord.rows() > 0) {
        mesh.corner_texcoord.resize(static_cast<long>(corners.size()), 2);
        for (std::size_t c = 0; c < corners.size(); ++c)
            mesh.corner_texcoord.row(static_cast<long>(c)) = old.corner_texcoord.row(corners[c]);
    }
}

}  // namespace risorius::geom
