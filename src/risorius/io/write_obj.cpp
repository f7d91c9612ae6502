// SPDX-License-Identifier: MIT
// Writes Wavefront OBJ: groups, polygons of any size and texture coordinates, in the order of the mesh.
#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <system_error>
#include <vector>

#include "risorius/core/error.h"
#include "risorius/core/json_cursor.h"
#include "risorius/core/output_set.h"
#include "risorius/io/read_mesh.h"

namespace risorius::io {

namespace fs = std::filesystem;

namespace {

const std::string kPlain = "plain";  // the material of faces without a picture

/// `materials`: for each picture the name of its material, empty where it has none. No materials are named when there are none.
std::string obj_text(const geom::PolygonMesh& mesh, double metres_per_unit,
                     const std::vector<std::string>& materials = {}) {
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
    std::string material;
    for (int f = 0; f < mesh.face_count(); ++f) {
        if (mesh.face_group[f] != group) {
            group = mesh.face_group[f];
            (out += "g ") += mesh.group_names[group];
            out += '\n';
        }
        if (!materials.empty()) {
            const int picture = mesh.face_texture[static_cast<std::size_t>(f)];
            const std::string own = picture < 0 ? "" : materials[static_cast<std::size_t>(picture)];
            const std::string& name = own.empty() ? kPlain : own;
            if (name != material) ((out += "usemtl ") += name) += '\n';
            material = name;
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

/// The ending of a picture's file, by its first bytes.
std::string ending_of(const std::vector<std::uint8_t>& bytes) {
    const auto begins_with = [&](const std::string& mark) {
        return bytes.size() >= mark.size() &&
               std::equal(mark.begin(), mark.end(), bytes.begin(),
                          [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
    };
    if (begins_with("\x89PNG")) return ".png";
    if (begins_with("\xff\xd8")) return ".jpg";
    return begins_with("BM") ? ".bmp" : ".tga";
}

std::string material_of(std::size_t picture) { return "picture_" + std::to_string(picture + 1); }

/// The path of a picture as a file of materials in `folder` names it; empty when it cannot.
std::string name_in_materials(const fs::path& picture, const fs::path& folder) {
    const std::string name =
        fs::proximate(fs::absolute(picture), fs::absolute(folder)).generic_string();
    // The line ends with the name, and a backslash would separate folders.
    const auto is_wrong = [](char c) {
        return static_cast<unsigned char>(c) < ' ' || c == '\\' || c == '\x7f';
    };
    if (name.empty() || name.back() == ' ' || std::any_of(name.begin(), name.end(), is_wrong))
        return "";
    return name.front() == '-' || name.front() == ' ' ? "./" + name : name;
}

}  // namespace

std::vector<fs::path> obj_files(const geom::PolygonMesh& mesh, const fs::path& obj) {
    std::vector<fs::path> files{obj};
    if (mesh.textures.empty()) return files;
    files.push_back(fs::path(obj).replace_extension(".mtl"));
    for (const geom::Texture& texture : mesh.textures)
        if (!texture.embedded.empty())
            files.push_back(fs::path(obj).replace_filename(obj.stem().string() + "_" +
                                                           std::to_string(files.size() - 1) +
                                                           ending_of(texture.embedded)));
    return files;
}

std::vector<std::string> write_obj_with_pictures(const geom::PolygonMesh& mesh, const fs::path& obj,
                                                 const std::vector<fs::path>& places) {
    const std::vector<fs::path> files = obj_files(mesh, obj);
    if (files.size() == 1) {
        write_obj(mesh, places.at(0));
        return {};
    }
    std::vector<std::string> notes, materials;
    std::string library = "newmtl " + kPlain + "\n";
    std::size_t inside = 2;  // the next file of a picture
    for (std::size_t i = 0; i < mesh.textures.size(); ++i) {
        const geom::Texture& texture = mesh.textures[i];
        fs::path picture = texture.file;
        if (!texture.embedded.empty()) {
            picture = files[inside];
            write_file(places.at(inside++), {reinterpret_cast<const char*>(texture.embedded.data()),
                                             texture.embedded.size()});
        }
        const std::string name = name_in_materials(picture, obj.parent_path());
        materials.push_back(name.empty() ? "" : material_of(i));
        if (name.empty())
            notes.push_back(texture.named_in + ": the picture is left out of " + obj.string() +
                            ", because a file of materials cannot name \"" + picture.string() +
                            "\"");
        else
            library += "newmtl " + material_of(i) + "\nmap_Kd " + name + "\n";
    }
    write_file(places.at(1), library);
    write_file(places.at(0),
               "mtllib " + files[1].filename().string() + "\n" + obj_text(mesh, 1, materials));
    return notes;
}

void write_obj(const geom::PolygonMesh& mesh, const std::filesystem::path& file,
               double metres_per_unit) {
    write_file(file, obj_text(mesh, metres_per_unit));
}

}  // namespace risorius::io
