// SPDX-License-Identifier: MIT
#include "risorius/fitting/detail/mesh_parts.h"

#include <algorithm>
#include <set>

#include "risorius/fitting/part_guess.h"
#include "risorius/geom/mesh_groups.h"
#include "risorius/geom/surface_topology.h"
#include "risorius/geom/weld.h"

namespace risorius::fitting {
namespace {

constexpr double kLargestHead_m = 1.0;  // longest side of the skin; see geom/mesh_checks.h
constexpr double kNeck_m = 0.12;        // below the chin

bool is_given(const std::map<std::string, std::vector<std::string>>& given,
              const std::string& group) {
    return std::any_of(given.begin(), given.end(), [&](const auto& part) {
        return std::find(part.second.begin(), part.second.end(), group) != part.second.end();
    });
}

/// The role that a material inside of a group suggests, without its side.
std::string role_of_material(const std::string& group, const std::string& material) {
    const std::string role = role_suggested_by(material);
    return role.empty() ? role_suggested_by(group) : role;
}

}  // namespace

void split_materials(geom::PolygonMesh& mesh,
                     const std::map<std::string, std::vector<std::string>>& given) {
    for (const auto& [role, groups] : given) geom::split_as_named(mesh, groups);
    const std::vector<std::string> names = mesh.group_names;
    for (const std::string& name : names) {
        const int group = mesh.group_index(name);
        if (group < 0 || is_given(given, name)) continue;
        std::set<std::string> roles;
        const auto materials = geom::materials_of_groups(mesh);
        for (const std::string& material : materials[static_cast<std::size_t>(group)])
            roles.insert(role_of_material(name, material));
        if (roles.size() > 1) geom::split_by_material(mesh, group);
    }
}

std::vector<std::string> split_sides(geom::PolygonMesh& mesh,
                                     const std::map<std::string, std::vector<std::string>>& given,
                                     const std::function<double(const Vec3&)>& left_of) {
    std::vector<std::string> notes;
    const std::vector<std::string> names = mesh.group_names;
    for (std::size_t g = 0; g < names.size(); ++g) {
        const std::string role = role_suggested_by(names[g]);
        if (is_given(given, names[g]) || (role != "eye" && role != "cornea" && role != "lashes"))
            continue;
        const geom::WeldedSurface welded =
            geom::weld(mesh.positions, geom::triangulate(mesh, {static_cast<int>(g)}));
        const geom::SurfacePieces pieces =
            geom::surface_pieces(welded.triangles, static_cast<int>(welded.positions.rows()));
        std::vector<Vec3> sum(static_cast<std::size_t>(pieces.count()), Vec3::Zero());
        std::vector<int> count(sum.size(), 0);
        for (long w = 0; w < welded.positions.rows(); ++w)
            if (const int piece = pieces.of_vertex[static_cast<std::size_t>(w)]; piece >= 0) {
                sum[static_cast<std::size_t>(piece)] += welded.positions.row(w).transpose();
                ++count[static_cast<std::size_t>(piece)];
            }
        std::vector<bool> is_left;
        for (std::size_t p = 0; p < sum.size(); ++p)
            is_left.push_back(left_of(sum[p] / std::max(1, count[p])) > 0);
        if (std::count(is_left.begin(), is_left.end(), true) == 0 ||
            std::count(is_left.begin(), is_left.end(), false) == 0)
            continue;
        const int left = static_cast<int>(mesh.group_names.size());
        mesh.group_names.push_back(names[g] + "_l");
        mesh.group_names.push_back(names[g] + "_r");
        for (int f = 0; f < mesh.face_count(); ++f) {
            int& group = mesh.face_group[static_cast<std::size_t>(f)];
            if (group != static_cast<int>(g)) continue;
            const int vertex = mesh.corner_vertex[static_cast<std::size_t>(
                mesh.face_begin[static_cast<std::size_t>(f)])];
            const int w = welded.welded_of_vertex[static_cast<std::size_t>(vertex)];
            const int piece = w < 0 ? -1 : pieces.of_vertex[static_cast<std::size_t>(w)];
            group = piece < 0 || is_left[static_cast<std::size_t>(piece)] ? left : left + 1;
        }
        notes.push_back("group \"" + names[g] + "\" is divided into \"" + names[g] + "_l\" and \"" +
                        names[g] + "_r\", by where its pieces lie");
    }
    if (!notes.empty()) geom::drop_empty_groups(mesh);
    return notes;
}

int hide_body(geom::PolygonMesh& mesh, const std::vector<std::string>& skin_groups,
              const std::function<Vec3(const Vec3&)>& to_head, const Vec3& chin, double size) {
    std::vector<bool> is_skin(mesh.group_names.size(), false);
    for (const std::string& name : skin_groups)
        if (const int group = mesh.group_index(name); group >= 0)
            is_skin[static_cast<std::size_t>(group)] = true;
    Vec3 low = Vec3::Constant(1e300), high = -low;
    std::vector<int> below;
    for (int f = 0; f < mesh.face_count(); ++f) {
        if (!is_skin[static_cast<std::size_t>(mesh.face_group[static_cast<std::size_t>(f)])])
            continue;
        double top = -1e300;
        for (int c = mesh.face_begin[static_cast<std::size_t>(f)];
             c < mesh.face_begin[static_cast<std::size_t>(f) + 1]; ++c) {
            const Vec3 p = to_head(
                mesh.positions.row(mesh.corner_vertex[static_cast<std::size_t>(c)]).transpose());
            low = low.cwiseMin(p);
            high = high.cwiseMax(p);
            top = std::max(top, p.y());
        }
        if (top < chin.y() - kNeck_m * size) below.push_back(f);
    }
    if (!((high - low).maxCoeff() > kLargestHead_m) || below.empty()) return 0;
    const int body = static_cast<int>(mesh.group_names.size());
    mesh.group_names.push_back(kBodyGroup);
    for (const int f : below) mesh.face_group[static_cast<std::size_t>(f)] = body;
    return static_cast<int>(below.size());
}

}  // namespace risorius::fitting
