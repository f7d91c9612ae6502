#include "sculpt/eyes.h"

#include <algorithm>
#include <cmath>

namespace risorius::sculpt {

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
    const auto face = [&](std::vector<int> corners) {
        if (side < 0) std::reverse(corners.begin(), corners.end());
        mesh.corner_vertex.insert(mesh.corner_vertex.end(), corners.begin(), corners.end());
        mesh.face_begin.push_back(static_cast<int>(mesh.corner_vertex.size()));
        mesh.face_group.push_back(0);
    };
    for (int k = 0; k < kAround; ++k) {
        const int next = (k + 1) % kAround;
        face({0, 1 + k, 1 + next});
        for (int ring = 1; ring + 1 < kRings; ++ring) {
            const int a = 1 + (ring - 1) * kAround, b = a + kAround;
            face({a + k, b + k, b + next, a + next});
        }
        face({last, last - kAround + next, last - kAround + k});
    }
    return mesh;
}

}  // namespace risorius::sculpt
