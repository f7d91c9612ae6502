// SPDX-License-Identifier: MIT
#include "risorius/blendshapes/detail/rigid_parts.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>

#include "risorius/core/rotations.h"
#include "risorius/geom/surface_topology.h"

namespace risorius::blendshapes {

namespace {

// Where pieces of the skin's group are teeth: so far aside of, above and below, and behind the slit of the lips
constexpr double kBeside_mm = 35, kAround_mm = 30, kBehind_mm = 70;

bool names_rigid_part(const std::string& group) {
    std::string name;
    for (const char c : group)
        name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const auto has = [&](const char* part) { return name.find(part) != std::string::npos; };
    if (has("teeth") || has("tooth")) return true;
    return has("eye") && !(has("brow") || has("lash") || has("lid") || has("socket") ||
                           has("wet") || has("shadow") || has("occlusion"));
}

bool is_rigid_role(const std::string& role) {
    return role.starts_with("teeth") || role == "eye_l" || role == "eye_r" ||
           role.starts_with("cornea");
}

bool in_mouth(const rig::Head& head, const std::vector<int>& piece) {
    const Vec3 slit = head.landmark("sto");
    return std::all_of(piece.begin(), piece.end(), [&](int v) {
        const Vec3 from = head.vertices.row(v).transpose() - slit;
        return std::abs(from.x()) < head.mm(kBeside_mm) &&
               std::abs(from.y()) < head.mm(kAround_mm) && from.z() < 0 &&
               from.z() > -head.mm(kBehind_mm);
    });
}

}  // namespace

std::vector<std::vector<int>> rigid_parts(const rig::Head& head, const geom::PolygonMesh& mesh) {
    std::vector<std::vector<int>> out;
    for (std::size_t g = 0; g < mesh.group_names.size(); ++g) {
        const std::string& role = head.role_of_group[g];
        const bool rigid =
            is_rigid_role(role) || (role != "eye_socket" && names_rigid_part(mesh.group_names[g]));
        if (!rigid && role != "skin") continue;
        Triangles triangles = geom::triangulate(mesh, {static_cast<int>(g)});
        for (int& v : triangles.reshaped()) v = head.welded[static_cast<std::size_t>(v)];
        const geom::SurfacePieces pieces =
            geom::surface_pieces(triangles, static_cast<int>(head.vertices.rows()));
        std::vector<std::vector<int>> of_piece(static_cast<std::size_t>(pieces.count()));
        for (std::size_t v = 0; v < pieces.of_vertex.size(); ++v)
            if (const int piece = pieces.of_vertex[v]; piece >= 0)
                of_piece[static_cast<std::size_t>(piece)].push_back(static_cast<int>(v));
        for (std::vector<int>& piece : of_piece)
            if (rigid || in_mouth(head, piece)) out.push_back(std::move(piece));
    }
    return out;
}

double bent_by_m(const std::vector<std::vector<int>>& parts, const Points& rest,
                 const Points& moved) {
    double worst = 0;
    for (const std::vector<int>& part : parts) {
        const Points from = rest(part, Eigen::indexing::all),
                     to = moved(part, Eigen::indexing::all);
        const Rigid motion = nearest_motion(from, to);
        for (long i = 0; i < from.rows(); ++i)
            worst = std::max(
                worst, (motion * Vec3(from.row(i).transpose()) - to.row(i).transpose()).norm());
    }
    return worst;
}

}  // namespace risorius::blendshapes
