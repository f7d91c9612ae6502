#include "lashes.h"

#include <algorithm>
#include <cmath>

namespace risorius::sculpt {

geom::PolygonMesh lashes(const Skin& skin, const Globe& globe, double side, const std::string& group) {
    constexpr int kLoop = 44, kInner = 5, kOuter = 27, kSegments = 4;
    geom::PolygonMesh mesh;
    mesh.group_names = {group};
    std::vector<Vec3> points;
    const auto margin = [&](double place) {
        const int k = static_cast<int>(std::floor(place));
        const double t = place - k;
        const auto at = [&](int i) { return skin.mesh.point[static_cast<std::size_t>(skin.lid_margin[static_cast<std::size_t>(i % kLoop)])]; };
        return Vec3((1 - t) * at(k) + t * at(k + 1));
    };
    const auto strip = [&](double place, bool upper, double length, double fan) {
        const Vec3 root = margin(place);
        const Vec3 tangent = (margin(place + 0.5) - margin(place - 0.5)).normalized();
        const Vec3 forward = (root - globe.centre).normalized();
        const Vec3 lift(0, upper ? 1 : -1, 0);
        Vec3 p = root - 0.15 * forward;
        const double width = upper ? 0.16 : 0.11;
        const int first = static_cast<int>(points.size());
        for (int s = 0; s <= kSegments; ++s) {
            const double t = static_cast<double>(s) / kSegments;
            const Vec3 half = tangent * (width * (1 - 0.85 * t));
            points.push_back(p - half);
            points.push_back(p + half);
            // Leaves the lid forwards, then turns up (upper lid) or down (lower lid).
            const Vec3 heading = (forward * (1.1 - 0.55 * t) + lift * ((upper ? 0.0 : 0.25) + (upper ? 1.3 : 0.6) * t) +
                                  Vec3(fan, 0, 0) + Vec3(0, upper ? -0.15 * (1 - t) : 0, 0)).normalized();
            p += heading * length / kSegments;
        }
        for (int s = 0; s < kSegments; ++s) {
            const int a = first + 2 * s;
            for (const int c : {a, a + 1, a + 3, a + 2}) mesh.corner_vertex.push_back(c);
            mesh.face_begin.push_back(static_cast<int>(mesh.corner_vertex.size()));
            mesh.face_group.push_back(0);
        }
    };
    const auto row = [&](int from, int to, int count, bool upper) {
        for (int i = 0; i < count; ++i) {
            // A fixed uneven step keeps the row from looking like a comb.
            const double uneven = 0.35 * std::sin(12.9898 * (i + 1)) + 0.25 * std::sin(78.233 * (i + 1));
            const double t = std::clamp((i + 0.5 + 0.5 * uneven) / count, 0.02, 0.98);
            const double place = from + 1.5 + t * (to - from - 2.5);
            const double x = (margin(place).x() - 31.5) / 14.0;
            const double length = (upper ? 7.0 : 4.2) * (0.55 + 0.45 * std::sqrt(std::max(0.0, 1 - 0.7 * x * x))) *
                                  (1 + 0.12 * uneven) * (upper && x > 0 ? 1.1 : 1.0);
            strip(place, upper, length, 0.55 * x);
        }
    };
    row(kOuter, kLoop + kInner, 46, true);
    row(kInner, kOuter, 30, false);
    mesh.positions.resize(static_cast<long>(points.size()), 3);
    for (std::size_t v = 0; v < points.size(); ++v) {
        mesh.positions.row(static_cast<long>(v)) = points[v].transpose();
        mesh.positions(static_cast<long>(v), 0) *= side;
    }
    return mesh;
}

}  // namespace risorius::sculpt
