// SPDX-License-Identifier: MIT
#include "risorius/headmodel/detail/eyes.h"

#include <algorithm>
#include <cmath>

#include "risorius/headmodel/detail/part_layout.h"

namespace risorius::headmodel {

double Globe::radius_at(double cosine) const {
    // The ray from the centre meets the corneal sphere at the greater root.
    const double b = cornea_centre * cosine;
    const double under = b * b - cornea_centre * cornea_centre + cornea_radius * cornea_radius;
    const double cornea = cosine > 0 && under > 0 ? b + std::sqrt(under) : 0.0;
    // A soft maximum rounds the limbus over about half a millimetre.
    const double d = cornea - sclera_radius, soft = 0.25;
    return sclera_radius + 0.5 * (d + std::sqrt(d * d + soft * soft)) -
           0.5 * soft * soft / (std::abs(d) + soft) * 0.5;
}

geom::PolygonMesh globe_mesh(const Globe& globe, double side, const std::string& group) {
    constexpr int kRings = 36, kAround = 40;
    geom::PolygonMesh mesh;
    mesh.group_names = {group};
    mesh.positions.resize(2 + (kRings - 1) * kAround, 3);
    const auto put = [&](int row, double angle, double around) {
        const double r = globe.radius_at(std::cos(angle));
        mesh.positions.row(row) << side *
                                       (globe.centre.x() + r * std::sin(angle) * std::cos(around)),
            globe.centre.y() + r * std::sin(angle) * std::sin(around),
            globe.centre.z() + r * std::cos(angle);
    };
    put(0, 0, 0);
    for (int ring = 1; ring < kRings; ++ring) {
        // Denser in front, where the highlight is.
        const double t = static_cast<double>(ring) / kRings;
        const double angle = M_PI * t * (0.55 + 0.45 * t);
        for (int k = 0; k < kAround; ++k)
            put(1 + (ring - 1) * kAround + k, angle, 2 * M_PI * k / kAround);
    }
    const int last = 1 + (kRings - 1) * kAround;
    put(last, M_PI, 0);
    const Disc disc = eye_disc(side);
    std::vector<Vec2> places;
    // A vertex by its ring and how many steps around it is; the pole of the back lies behind each face's own middle.
    struct Corner {
        int ring;
        double around;
    };
    const auto face = [&](std::vector<Corner> corners) {
        if (side < 0) std::reverse(corners.begin(), corners.end());
        for (const auto& [ring, around] : corners) {
            mesh.corner_vertex.push_back(ring == 0        ? 0
                                         : ring == kRings ? last
                                                          : 1 + (ring - 1) * kAround +
                                                                static_cast<int>(around) % kAround);
            places.push_back(
                disc.at(static_cast<double>(ring) / kRings, 2 * M_PI * around / kAround));
        }
        mesh.face_begin.push_back(static_cast<int>(mesh.corner_vertex.size()));
        mesh.face_group.push_back(0);
    };
    for (int k = 0; k < kAround; ++k) {
        const double a = k, b = k + 1, between = k + 0.5;
        face({{0, between}, {1, a}, {1, b}});
        for (int ring = 1; ring + 1 < kRings; ++ring)
            face({{ring, a}, {ring + 1, a}, {ring + 1, b}, {ring, b}});
        face({{kRings, between}, {kRings - 1, b}, {kRings - 1, a}});
    }
    mesh.corner_texcoord.resize(static_cast<long>(places.size()), 2);
    for (std::size_t c = 0; c < places.size(); ++c)
        mesh.corner_texcoord.row(static_cast<long>(c)) = places[c].transpose();
    return mesh;
}

}  // namespace risorius::headmodel
