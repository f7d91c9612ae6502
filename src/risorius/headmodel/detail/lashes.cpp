// SPDX-License-Identifier: MIT
#include "risorius/headmodel/detail/lashes.h"

#include <cmath>

#include "risorius/render/lash_picture.h"

namespace risorius::headmodel {

geom::PolygonMesh lashes(const Skin& skin, const Globe& globe, double side,
                         const std::string& group) {
    constexpr int kLoop = 44, kInner = 5, kOuter = 27, kSegments = 5;
    geom::PolygonMesh mesh;
    mesh.group_names = {group};
    std::vector<Vec3> points;
    std::vector<Vec2> places, corner_places;
    const auto ribbon = [&](int from, int to, bool upper) {
        const int first = static_cast<int>(points.size());
        for (int k = from; k <= to; ++k) {
            const Vec3 root = skin.mesh.point[static_cast<std::size_t>(
                skin.lid_margin[static_cast<std::size_t>(k % kLoop)])];
            const Vec3 forward = (root - globe.centre).normalized();
            const double x = (root.x() - 31.0) / 14.5;  // -1 at the inner canthus, 1 at the outer
            const double length = (upper ? 7.5 : 4.5) *
                                  (0.5 + 0.5 * std::sqrt(std::max(0.0, 1 - x * x))) *
                                  (1 + (upper ? 0.18 : 0.1) * x);
            Vec3 p = root;
            for (int s = 0; s <= kSegments; ++s) {
                points.push_back(p);
                places.push_back(render::lash_place(upper,
                                                    static_cast<double>(k - from) / (to - from),
                                                    static_cast<double>(s) / kSegments));
                // Leaves the lid forwards and a little down, then turns up (upper lid); forwards and down (lower lid).
                const double t = (s + 0.5) / kSegments;
                const double lift = upper ? -0.25 + 1.5 * t : -0.35 - 0.45 * t;
                const Vec3 heading =
                    (forward * (1.1 - 0.5 * t) + Vec3(0.55 * x, lift, 0.25)).normalized();
                p += heading * length / kSegments;
            }
        }
        for (int k = 0; k < to - from; ++k)
            for (int s = 0; s < kSegments; ++s) {
                const int a = first + k * (kSegments + 1) + s, b = a + kSegments + 1;
                const int corners[4] = {a, b, b + 1, a + 1};
                for (int i = 0; i < 4; ++i) {
                    const int v = corners[(side < 0) != upper ? i : 3 - i];
                    mesh.corner_vertex.push_back(v);
                    corner_places.push_back(places[static_cast<std::size_t>(v)]);
                }
                mesh.face_begin.push_back(static_cast<int>(mesh.corner_vertex.size()));
                mesh.face_group.push_back(0);
            }
    };
    ribbon(kOuter + 1, kLoop + kInner - 3, true);
    ribbon(kInner + 4, kOuter - 2, false);
    mesh.corner_texcoord.resize(static_cast<long>(corner_places.size()), 2);
    for (std::size_t c = 0; c < corner_places.size(); ++c)
        mesh.corner_texcoord.row(static_cast<long>(c)) = corner_places[c].transpose();
    mesh.positions.resize(static_cast<long>(points.size()), 3);
    for (std::size_t v = 0; v < points.size(); ++v) {
        mesh.positions.row(static_cast<long>(v)) = points[v].transpose();
        mesh.positions(static_cast<long>(v), 0) *= side;
    }
    return mesh;
}

}  // namespace risorius::headmodel
