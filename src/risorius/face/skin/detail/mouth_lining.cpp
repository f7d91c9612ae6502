// SPDX-License-Identifier: MIT
#include "risorius/face/skin/detail/mouth_lining.h"

#include <algorithm>
#include <cmath>

#include "risorius/geom/closest_point.h"

namespace risorius::face {

namespace {

constexpr double kFar_mm = 12.0;  // lining deeper than this never reaches the skin
constexpr double kNear_mm = 0.3;  // lining nearer than this is skin that turns inwards
constexpr double kClearance_mm = 1.5;
constexpr double kFacing =
    0.6;  // minimum cosine: the skin must lie in front of the point, not beside it

}  // namespace

MouthLining::MouthLining(const rig::Head& head) {
    if (head.lining.rows() == 0 || head.skin.rows() == 0) return;
    std::vector<char> of_skin(static_cast<std::size_t>(head.vertices.rows()), 0);
    std::vector<char> of_lining = of_skin;
    for (long i = 0; i < head.skin.size(); ++i)
        of_skin[static_cast<std::size_t>(head.skin.data()[i])] = 1;
    for (long i = 0; i < head.lining.size(); ++i)
        of_lining[static_cast<std::size_t>(head.lining.data()[i])] = 1;
    const geom::SurfaceTree skin(head.vertices, head.skin);
    std::vector<char> is_kept(of_skin.size(), 0);
    for (long v = 0; v < head.vertices.rows(); ++v) {
        if (!of_lining[static_cast<std::size_t>(v)] || of_skin[static_cast<std::size_t>(v)])
            continue;
        const Vec3 x = head.vertices.row(v);
        const auto front = skin.closest(x, head.mm(kFar_mm));
        if (!front) continue;
        Kept kept{static_cast<int>(v), {}, front->barycentric, 0};
        for (int k = 0; k < 3; ++k)
            kept.corner[static_cast<std::size_t>(k)] = head.skin(front->triangle, k);
        const Vec3 a = head.vertices.row(kept.corner[0]), b = head.vertices.row(kept.corner[1]),
                   c = head.vertices.row(kept.corner[2]);
        const double away = std::sqrt(front->squared_distance);
        const double behind = (front->point - x).dot((b - a).cross(c - a).normalized());
        if (away < head.mm(kNear_mm) || behind < kFacing * away) continue;
        kept.clearance_m = std::min(0.5 * behind, head.mm(kClearance_mm));
        kept_.push_back(kept);
        is_kept[static_cast<std::size_t>(v)] = 1;
    }
    for (std::size_t v = 0; v < head.welded.size(); ++v) {
        const int like = head.welded[v];
        if (like != static_cast<int>(v) && is_kept[static_cast<std::size_t>(like)])
            alike_.push_back({static_cast<int>(v), like});
    }
}

void MouthLining::stay_behind(Points& vertices) const {
    bool moved = false;
    for (const Kept& kept : kept_) {
        const Vec3 a = vertices.row(kept.corner[0]), b = vertices.row(kept.corner[1]),
                   c = vertices.row(kept.corner[2]);
        const Vec3 cross = (b - a).cross(c - a);
        const double twice_area = cross.norm();
        if (twice_area < 1e-12) continue;
        const Vec3 front =
            kept.barycentric[0] * a + kept.barycentric[1] * b + kept.barycentric[2] * c;
        const Vec3 normal = cross / twice_area;
        const double lacking =
            kept.clearance_m - (front - vertices.row(kept.vertex).transpose()).dot(normal);
        if (lacking <= 0) continue;
        vertices.row(kept.vertex) -= lacking * normal.transpose();
        moved = true;
    }
    if (!moved) return;
    for (const auto& [vertex, like] : alike_) vertices.row(vertex) = vertices.row(like);
}

}  // namespace risorius::face
