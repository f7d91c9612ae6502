// SPDX-License-Identifier: MIT
#include "risorius/face/skin/detail/tongue_tip.h"

#include <algorithm>
#include <cmath>

#include "risorius/geom/polyline.h"

namespace risorius::face {

namespace {

// The ridge lies above the edge of the upper incisors; its height is that of the middle of their gums. Of the average adult
constexpr double kAboveEdge_mm = 9, kRidge_mm = 3, kBehindEdge_mm = 7.5, kDeepest_mm = 12;
constexpr double kGumsAside_mm = 2.5;  // points of the gums that count, from the middle
constexpr double kReach_mm = 24;       // no tip comes farther
constexpr double kTipFilm_mm = 0.2;    // between tip and ridge in contact
constexpr double kBladeFrom = 0.3;  // place along the tongue from which the blade follows the tip
constexpr double kShortest = -0.4;  // change of the length of a piece of the blade
constexpr double kTip = 0.97;       // from here on it is the tip

}  // namespace

TongueTip::TongueTip(const rig::Head& head, const Vec3& upper_edge, double length_m)
    : reach_m_(head.mm(kReach_mm)), length_m_(length_m) {
    const double y = upper_edge.y() + head.mm(kAboveEdge_mm);
    ridge_ = {0, y, 1e300};
    for (long v = 0; v < head.vertices.rows(); ++v)
        if (head.carrier[static_cast<std::size_t>(v)] == rig::Carrier::kSkull &&
            std::abs(head.vertices(v, 0)) < head.mm(kGumsAside_mm) &&
            std::abs(head.vertices(v, 1) - y) < head.mm(kRidge_mm) &&
            head.vertices(v, 2) > upper_edge.z() - head.mm(kDeepest_mm) &&
            head.vertices(v, 2) < ridge_.z())
            ridge_ = {0, head.vertices(v, 1), head.vertices(v, 2)};
    if (ridge_.z() > 1e299) ridge_ = {0, y, upper_edge.z() - head.mm(kBehindEdge_mm)};
    ridge_.z() -= head.mm(kTipFilm_mm);
}

void TongueTip::raise(double up, double share, std::vector<TonguePoint>& points) const {
    if (up <= 0 || share <= 0 || points.empty()) return;
    // The foremost part of the tip that is highest touches first
    const TonguePoint* tip = nullptr;
    for (const TonguePoint& point : points)
        if (point.along > kTip && std::abs(point.side) < 0.25 * reach_m_ &&
            (!tip || point.along > tip->along))
            tip = &point;
    if (!tip) return;
    Vec3 way = ridge_ - tip->p;
    way.x() = 0;
    // On a head whose tongue is one piece with the floor of the mouth, a curl may have taken it beyond.
    if (way.y() <= 0) return;
    if (const double far = way.norm(); far > reach_m_) way *= reach_m_ / far;
    way *= share * geom::smoothstep(0, kTipAtRidge, up);
    for (TonguePoint& point : points) {
        // A blade that becomes longer becomes narrower
        const double s = std::clamp((point.along - kBladeFrom) / (1 - kBladeFrom), 0.0, 1.0),
                     longer = 6 * s * (1 - s) / (1 - kBladeFrom) * way.z() / length_m_;
        point.p += geom::smoothstep(0.0, 1.0, s) * way;
        point.p.x() /= 1 + std::max(longer, kShortest);
    }
}

}  // namespace risorius::face
