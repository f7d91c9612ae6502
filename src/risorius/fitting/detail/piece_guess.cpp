// SPDX-License-Identifier: MIT
#include "risorius/fitting/detail/piece_guess.h"

#include <algorithm>
#include <cmath>

#include "risorius/geom/fitted_sphere.h"
#include "risorius/geom/surface_topology.h"
#include "risorius/geom/weld.h"

namespace risorius::fitting {
namespace {

constexpr double kSmallestEye_mm = 8, kLargestEye_mm = 18;  // radius of an eyeball
// Largest distance of its centre from the position expected from the lids
constexpr double kEyeOff_mm = 14;
// RMS distance from a sphere over its radius; not smaller because of the cornea
constexpr double kEyeUnround = 0.15;
constexpr double kBehindLids_mm = 12;

bool is_eye(const std::vector<Vec3>& points, const Vec3& expected, double mm) {
    if (points.size() < 20) return false;
    const geom::Sphere sphere = geom::fitted_sphere(points);
    const Vec3 centre = (sphere.centre - expected) / mm;
    const double radius = sphere.radius / mm;
    double squared = 0;
    for (const Vec3& p : points)
        squared += std::pow(((p - expected) / mm - centre).norm() - radius, 2);
    return radius > kSmallestEye_mm && radius < kLargestEye_mm && centre.norm() < kEyeOff_mm &&
           std::sqrt(squared / static_cast<double>(points.size())) < kEyeUnround * radius;
}

/// Whether the points lie behind the lips and between the corners, or slightly beyond.
bool is_in_mouth(const std::vector<Vec3>& points, const std::map<std::string, Vec3>& landmarks,
                 double mm) {
    const double width = landmarks.at("ch_l").x() - landmarks.at("ch_r").x();
    return std::all_of(points.begin(), points.end(), [&](const Vec3& p) {
        return std::abs(p.x()) < width && p.y() < landmarks.at("sn").y() + 6 * mm &&
               p.y() > landmarks.at("me").y() && p.z() < landmarks.at("sto").z() + 4 * mm;
    });
}

bool fills_the_middle(const std::vector<Vec3>& points, const std::map<std::string, Vec3>& landmarks,
                      double mm) {
    const auto inside = std::count_if(points.begin(), points.end(), [&](const Vec3& p) {
        return std::abs(p.x()) < 8 * mm && p.z() < landmarks.at("ch_l").z() - 12 * mm;
    });
    return static_cast<double>(inside) > 0.2 * static_cast<double>(points.size());
}

}  // namespace

std::vector<std::string> group_pieces(geom::PolygonMesh& mesh,
                                      const std::function<Vec3(const Vec3&)>& to_head,
                                      const std::map<std::string, Vec3>& landmarks, double size) {
    if (mesh.group_names.size() != 1) return {};
    Points vertices(mesh.vertex_count(), 3);
    for (long v = 0; v < vertices.rows(); ++v)
        vertices.row(v) = to_head(mesh.positions.row(v).transpose()).transpose();
    const geom::WeldedSurface welded = geom::weld(vertices, geom::triangulate(mesh));
    const geom::SurfacePieces pieces =
        geom::surface_pieces(welded.triangles, static_cast<int>(welded.positions.rows()));
    if (pieces.count() < 2) return {};
    const int skin = static_cast<int>(
        std::max_element(pieces.triangle_count.begin(), pieces.triangle_count.end()) -
        pieces.triangle_count.begin());

    // Classify each piece.
    const double mm = 1e-3 * size;
    std::vector<std::vector<Vec3>> points(static_cast<std::size_t>(pieces.count()));
    for (long w = 0; w < welded.positions.rows(); ++w)
        if (const int piece = pieces.of_vertex[static_cast<std::size_t>(w)]; piece >= 0)
            points[static_cast<std::size_t>(piece)].push_back(welded.positions.row(w).transpose());
    std::vector<int> group_of(static_cast<std::size_t>(pieces.count()), 0);
    std::vector<std::string> notes;
    for (int piece = 0; piece < pieces.count(); ++piece) {
        if (piece == skin) continue;
        const std::vector<Vec3>& own = points[static_cast<std::size_t>(piece)];
        std::string name = "other";
        for (const char* side : {"_l", "_r"}) {
            const Vec3 lids = 0.5 * (landmarks.at(std::string("ps") + side) +
                                     landmarks.at(std::string("pi") + side));
            if (is_eye(own, lids - kBehindLids_mm * mm * Vec3::UnitZ(), mm))
                name = std::string("eye") + side;
        }
        if (name == "other" && is_in_mouth(own, landmarks, mm))
            name = fills_the_middle(own, landmarks, mm) ? "tongue" : "teeth";
        int group = mesh.group_index(name);
        if (group < 0) {
            group = static_cast<int>(mesh.group_names.size());
            mesh.group_names.push_back(name);
            notes.push_back("a piece without a name is taken as " +
                            (name == "other" ? "nothing, and hidden" : name) +
                            ", by where it lies");
        }
        group_of[static_cast<std::size_t>(piece)] = group;
    }
    mesh.group_names[0] = "skin";
    for (int f = 0; f < mesh.face_count(); ++f) {
        const int vertex = mesh.corner_vertex[static_cast<std::size_t>(
            mesh.face_begin[static_cast<std::size_t>(f)])];
        const int w = welded.welded_of_vertex[static_cast<std::size_t>(vertex)];
        const int piece = w < 0 ? -1 : pieces.of_vertex[static_cast<std::size_t>(w)];
        mesh.face_group[static_cast<std::size_t>(f)] =
            piece < 0 ? 0 : group_of[static_cast<std::size_t>(piece)];
    }
    return notes;
}

}  // namespace risorius::fitting
