// SPDX-License-Identifier: MIT
#include "risorius/headmodel/detail/head_model.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "risorius/core/error.h"
#include "risorius/core/output_set.h"
#include "risorius/headmodel/detail/lashes.h"
#include "risorius/headmodel/detail/layout.h"
#include "risorius/headmodel/detail/oral.h"

namespace risorius::headmodel {
namespace {

void append(geom::PolygonMesh& whole, const geom::PolygonMesh& part) {
    const int base = whole.vertex_count();
    Points joined(base + part.vertex_count(), 3);
    joined.topRows(base) = whole.positions;
    joined.bottomRows(part.vertex_count()) = part.positions;
    whole.positions = joined;
    // What has no layout yet is at (0, 0).
    TexCoords places = TexCoords::Zero(
        static_cast<long>(whole.corner_vertex.size() + part.corner_vertex.size()), 2);
    places.topRows(whole.corner_texcoord.rows()) = whole.corner_texcoord;
    places.bottomRows(part.corner_texcoord.rows()) = part.corner_texcoord;
    whole.corner_texcoord = places;
    for (int f = 0; f < part.face_count(); ++f) {
        for (int c = part.face_begin[f]; c < part.face_begin[f + 1]; ++c)
            whole.corner_vertex.push_back(base + part.corner_vertex[c]);
        whole.face_begin.push_back(static_cast<int>(whole.corner_vertex.size()));
        whole.face_group.push_back(static_cast<int>(whole.group_names.size()) + part.face_group[f]);
    }
    whole.group_names.insert(whole.group_names.end(), part.group_names.begin(),
                             part.group_names.end());
}

/// Nearest vertices, each used once; the right side mirrors the left.
std::map<std::string, int> name_landmarks(const Skin& skin, const DesignTables& tables) {
    std::map<std::string, int> named = skin.landmark;
    std::set<int> used;
    for (const auto& [id, v] : named) used.insert(v);
    std::set<int> on_skin;
    for (std::size_t f = 0; f < skin.mesh.face.size(); ++f)
        if (skin.mesh.group[f] == 0)
            for (const int v : skin.mesh.face[f]) on_skin.insert(v);
    for (const auto& [id, p] : tables.landmarks) {
        if (p.x() < 0 || named.count(id)) continue;
        const bool middle = p.x() == 0;
        int best = -1;
        for (const int v : on_skin) {
            if (used.count(v) || (middle && !skin.mesh.midline[static_cast<std::size_t>(v)]))
                continue;
            if (best < 0 || (skin.mesh.point[static_cast<std::size_t>(v)] - p).squaredNorm() <
                                (skin.mesh.point[static_cast<std::size_t>(best)] - p).squaredNorm())
                best = v;
        }
        named[id] = best;
        used.insert(best);
    }
    const std::vector<int> other = mirror_map(skin.mesh);
    std::map<std::string, int> both = named;
    for (const auto& [id, v] : named)
        if (id.size() > 2 && id.ends_with("_l"))
            both[id.substr(0, id.size() - 2) + "_r"] = other[static_cast<std::size_t>(v)];
    return both;
}

/// Area-weighted means over the faces around each vertex, unit length.
std::vector<Vec3> vertex_normals(const geom::PolygonMesh& mesh) {
    std::vector<Vec3> normals(static_cast<std::size_t>(mesh.vertex_count()), Vec3::Zero());
    for (int f = 0; f < mesh.face_count(); ++f) {
        const int begin = mesh.face_begin[f], end = mesh.face_begin[f + 1];
        const auto at = [&](int c) -> Vec3 {
            return mesh.positions.row(mesh.corner_vertex[c]).transpose();
        };
        Vec3 area = Vec3::Zero();
        for (int c = begin; c + 2 < end; ++c)
            area += (at(c + 1) - at(begin)).cross(at(c + 2) - at(begin));
        for (int c = begin; c < end; ++c)
            normals[static_cast<std::size_t>(mesh.corner_vertex[c])] += area;
    }
    for (Vec3& n : normals) n /= std::max(n.norm(), 1e-12);
    return normals;
}

}  // namespace

namespace {

HeadModel made(const DesignTables& tables, bool laid_out) {
    const Globe globe;
    const HeadSurface surface(tables);
    const Skin skin = make_skin(tables, surface, globe);
    HeadModel model;
    model.mesh = mirrored(skin.mesh);
    append(model.mesh, globe_mesh(globe, 1, "eye_l"));
    append(model.mesh, globe_mesh(globe, -1, "eye_r"));
    for (const Arch arch : {Arch::kUpper, Arch::kLower}) {
        model.crown_height.resize(static_cast<std::size_t>(model.mesh.vertex_count()), 0);
        append(model.mesh, teeth(arch, arch == Arch::kUpper ? "teeth_upper" : "teeth_lower"));
        const std::vector<double> heights = crown_heights();
        model.crown_height.insert(model.crown_height.end(), heights.begin(), heights.end());
    }
    append(model.mesh, gums(Arch::kUpper, "gums_upper"));
    append(model.mesh, gums(Arch::kLower, "gums_lower"));
    append(model.mesh, tongue("tongue"));
    append(model.mesh, lashes(skin, globe, 1, "lashes_l"));
    append(model.mesh, lashes(skin, globe, -1, "lashes_r"));
    model.crown_height.resize(static_cast<std::size_t>(model.mesh.vertex_count()), 0);
    if (laid_out)
        lay_out(skin.mesh, tables.landmarks.at("v").z(), skin.upper_margin, skin.lower_margin,
                model.mesh);
    // Both halves have their faces in the same order.
    for (const bool mirror : {false, true})
        for (std::size_t f = 0; f < skin.mesh.face.size(); ++f)
            model.regions[region_names()[static_cast<std::size_t>(skin.mesh.region[f])]].push_back(
                static_cast<int>(f + (mirror ? skin.mesh.face.size() : 0)));
    model.landmarks = name_landmarks(skin, tables);
    return model;
}

}  // namespace

HeadModel make_head(const DesignTables& tables) { return made(tables, true); }
HeadModel make_form(const DesignTables& tables) { return made(tables, false); }

void write_head(const HeadModel& model, const std::filesystem::path& folder,
                const std::string& library) {
    std::string text =
        "# Risorius adult head, made by tools/sculpt from models/adult/design. CC0. Millimetres; "
        "see ORIGIN.md.\n";
    char line[96];
    const auto& mesh = model.mesh;
    const bool shown = !library.empty();
    if (shown) text.append("mtllib ").append(library).append("\n");
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        // Adding zero turns a rounded -0 into 0.
        const auto rounded = [&](int axis) {
            return std::round(mesh.positions(v, axis) * 1000) / 1000 + 0.0;
        };
        std::snprintf(line, sizeof line, "v %.3f %.3f %.3f\n", rounded(0), rounded(1), rounded(2));
        text += line;
    }
    if (shown)
        for (const Vec3& n : vertex_normals(mesh)) {
            const Vec3 rounded = (n * 1000).array().round() / 1000 + 0.0;
            std::snprintf(line, sizeof line, "vn %.3f %.3f %.3f\n", rounded.x(), rounded.y(),
                          rounded.z());
            text += line;
        }
    // Each place of the layout once
    std::map<std::pair<long, long>, int> numbers;
    std::vector<int> number(mesh.corner_vertex.size());
    for (long c = 0; c < mesh.corner_texcoord.rows(); ++c) {
        const std::pair<long, long> key{std::lround(mesh.corner_texcoord(c, 0) * 1e5),
                                        std::lround(mesh.corner_texcoord(c, 1) * 1e5)};
        const auto [entry, added] = numbers.emplace(key, static_cast<int>(numbers.size()) + 1);
        number[static_cast<std::size_t>(c)] = entry->second;
        if (!added) continue;
        std::snprintf(line, sizeof line, "vt %.5f %.5f\n", static_cast<double>(key.first) * 1e-5,
                      static_cast<double>(key.second) * 1e-5);
        text += line;
    }
    std::vector<int> place_in_file(static_cast<std::size_t>(mesh.face_count()));
    int written_faces = 0;
    for (std::size_t g = 0; g < mesh.group_names.size(); ++g) {
        text.append("g ").append(mesh.group_names[g]).append("\n");
        if (shown) text.append("usemtl ").append(mesh.group_names[g]).append("\n");
        for (int f = 0; f < mesh.face_count(); ++f) {
            if (mesh.face_group[f] != static_cast<int>(g)) continue;
            place_in_file[static_cast<std::size_t>(f)] = written_faces++;
            text += "f";
            for (int c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c)
                text.append(" ")
                    .append(std::to_string(mesh.corner_vertex[c] + 1))
                    .append("/")
                    .append(std::to_string(number[static_cast<std::size_t>(c)]))
                    .append(shown ? "/" + std::to_string(mesh.corner_vertex[c] + 1) : "");
            text += "\n";
        }
    }
    write_file(folder / "head.obj", text);

    text = "{\n  \"format\": \"risorius-landmarks\",\n  \"version\": 1,\n  \"landmarks\": {";
    const char* separator = "\n";
    for (const auto& [id, v] : model.landmarks) {
        text.append(separator).append("    \"").append(id).append("\": {\"vertex\": ");
        text.append(std::to_string(v)).append("}");
        separator = ",\n";
    }
    text += "\n  }\n}\n";
    write_file(folder / "landmarks.json", text);

    // Faces as they are counted in the file, from 0: runs of first and last.
    text = "{\n  \"format\": \"risorius-regions\",\n  \"version\": 1,\n  \"regions\": {";
    separator = "\n";
    for (const auto& [name, faces] : model.regions) {
        text.append(separator).append("    \"").append(name).append("\": [");
        // The file has the groups one after the other.
        std::vector<int> written;
        for (const int f : faces) written.push_back(place_in_file[static_cast<std::size_t>(f)]);
        std::sort(written.begin(), written.end());
        for (std::size_t k = 0; k < written.size();) {
            std::size_t last = k;
            while (last + 1 < written.size() && written[last + 1] == written[last] + 1) ++last;
            text.append(k > 0 ? ", [" : "[").append(std::to_string(written[k])).append(", ");
            text.append(std::to_string(written[last])).append("]");
            k = last + 1;
        }
        text += "]";
        separator = ",\n";
    }
    text += "\n  }\n}\n";
    write_file(folder / "regions.json", text);
}

}  // namespace risorius::headmodel
