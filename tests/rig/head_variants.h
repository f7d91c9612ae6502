// SPDX-License-Identifier: MIT
/// \file
/// Heads made from another head: other people, scans, other resolutions, mistakes in their landmarks.
#pragma once

#include <cmath>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "rig/heads.h"
#include "risorius/geom/closest_point.h"

namespace risorius::rig {

/// What a scanner sees of a head: one surface from crown to throat without groups, lips and lids grown together with what
/// lies between them. Rays towards a point inside of the head, closer to each other in front; quads.
inline geom::PolygonMesh scan_of(const Head& head, const geom::PolygonMesh& mesh, int rows,
                                 int columns) {
    std::vector<int> groups;
    for (std::size_t g = 0; g < head.role_of_group.size(); ++g)
        if (head.role_of_group[g] == "skin" || head.role_of_group[g] == "mouth" ||
            head.role_of_group[g].starts_with("eye_"))
            groups.push_back(static_cast<int>(g));
    const geom::SurfaceTree surface(head.vertices, geom::triangulate(mesh, groups));
    const Vec3 inside(0, head.mm(-12), head.mm(15));
    geom::PolygonMesh scan;
    scan.group_names = {"scan"};
    scan.positions.resize(static_cast<long>(rows) * columns, 3);
    constexpr double kPi = 3.14159265358979323846, kLowest = -1.0, kHighest = 1.5;
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c) {
            const double u = (2.0 * c + 1) / columns - 1;  // -1 .. 1 around, 0 in front
            const double around = kPi * (0.45 * u + 0.55 * u * u * u);
            const double up = kLowest + (kHighest - kLowest) * r / (rows - 1);
            const Vec3 out(std::cos(up) * std::sin(around), std::sin(up),
                           std::cos(up) * std::cos(around));
            const auto hit = surface.cast(inside + 0.4 * out, -out, 0.4);
            scan.positions.row(r * columns + c) =
                (hit ? hit->point : Vec3(inside + head.mm(60) * out)).transpose();
        }
    for (int r = 0; r + 1 < rows; ++r)
        for (int c = 0; c < columns; ++c) {
            const int next = (c + 1) % columns;
            for (int v : {r * columns + c, r * columns + next, (r + 1) * columns + next,
                          (r + 1) * columns + c})
                scan.corner_vertex.push_back(v);
            scan.face_begin.push_back(static_cast<int>(scan.corner_vertex.size()));
            scan.face_group.push_back(0);
        }
    return scan;
}

/// The rig of a scan: its only group is skin, and it has the landmarks `ids` of the head.
inline RigDescription rig_of_scan(const RigDescription& rig, const Head& head,
                                  const std::vector<std::string>& ids) {
    RigDescription out = rig;
    out.metres_per_unit = 1;
    out.parts = {{"skin", {"scan"}}};
    out.landmarks.clear();
    for (const std::string& id : ids) out.landmarks[id].xyz = head.landmark(id);
    return out;
}

/// Each triangle with three vertices of its own, as STL has them.
inline geom::PolygonMesh soup_of(const geom::PolygonMesh& mesh) {
    const Triangles triangles = geom::triangulate(mesh);
    geom::PolygonMesh soup;
    soup.group_names = {"soup"};
    soup.positions.resize(3 * triangles.rows(), 3);
    for (long f = 0; f < triangles.rows(); ++f) {
        for (int k = 0; k < 3; ++k) {
            soup.positions.row(3 * f + k) = mesh.positions.row(triangles(f, k));
            soup.corner_vertex.push_back(static_cast<int>(3 * f) + k);
        }
        soup.face_begin.push_back(static_cast<int>(soup.corner_vertex.size()));
        soup.face_group.push_back(0);
    }
    return soup;
}

/// The measured head as another person: its identity modes by their standard deviations.
inline geom::PolygonMesh with_identity(geom::PolygonMesh ict, const std::vector<double>& sigmas) {
    std::ifstream in(
        std::filesystem::path(RISORIUS_SHARED_DIR) / "data/heads/ict/ict_identity20.f32",
        std::ios::binary);
    const std::size_t numbers = 3 * static_cast<std::size_t>(ict.vertex_count());
    std::vector<float> mode(numbers);
    for (const double sigma : sigmas) {
        in.read(reinterpret_cast<char*>(mode.data()),
                static_cast<std::streamsize>(numbers * sizeof(float)));
        for (std::size_t i = 0; i < numbers; ++i) ict.positions.data()[i] += sigma * mode[i];
    }
    return ict;
}

}  // namespace risorius::rig
