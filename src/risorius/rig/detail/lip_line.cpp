// SPDX-License-Identifier: MIT
#include "risorius/rig/detail/lip_line.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "risorius/geom/closest_point.h"

namespace risorius::rig {

LipLine::LipLine(const Head& head)
    : right_(head.landmark("ch_r")), left_(head.landmark("ch_l")), middle_(head.landmark("sto")) {
    // Search for the deepest point between the lips, a few millimetres above or below the line of the landmarks.
    const geom::SurfaceTree skin(head.vertices, head.skin);
    constexpr int kReach = 8;  // half millimetres
    std::vector<double> offset(kStations + 1, 0.0);
    for (int i = 1; i < kStations; ++i) {
        const double x = x_of(i);
        const Vec3 base = plain(x);
        std::array<double, 2 * kReach + 1> z{};
        bool whole = true;
        for (int k = -kReach; k <= kReach; ++k) {
            const Vec3 from(x, base.y() + head.mm(0.5 * k), base.z() + head.mm(25));
            const auto hit = skin.cast(from, -Vec3::UnitZ(), head.mm(50));
            whole = whole && hit.has_value();
            z[static_cast<std::size_t>(k + kReach)] = hit ? hit->point.z() : 0;
        }
        if (!whole) continue;
        double best = head.mm(0.15);  // shallower furrows are ignored
        for (int k = -kReach + 1; k < kReach; ++k) {
            const double t = static_cast<double>(k + kReach) / (2 * kReach);
            const double chord = (1 - t) * z.front() + t * z.back();
            const double depth =
                chord - z[static_cast<std::size_t>(k + kReach)] - head.mm(0.08) * std::abs(k);
            if (depth <= best) continue;
            best = depth;
            offset[static_cast<std::size_t>(i)] = head.mm(0.5 * k);
        }
    }
    for (int pass = 0; pass < 4; ++pass) {
        std::vector<double> next = offset;
        for (std::size_t i = 1; i < kStations; ++i)
            next[i] = 0.25 * offset[i - 1] + 0.5 * offset[i] + 0.25 * offset[i + 1];
        offset = next;
    }
    offset_ = offset;
}

double LipLine::across(double x) const {
    return x < middle_.x() ? (x - middle_.x()) / (middle_.x() - right_.x())
                           : (x - middle_.x()) / (left_.x() - middle_.x());
}

Vec3 LipLine::at(double x) const {
    const double place =
        std::clamp((x - right_.x()) / (left_.x() - right_.x()), 0.0, 1.0) * kStations;
    const std::size_t i = std::min<std::size_t>(kStations - 1, static_cast<std::size_t>(place));
    const double t = place - static_cast<double>(i);
    return plain(x) + Vec3(0, (1 - t) * offset_[i] + t * offset_[i + 1], 0);
}

Vec3 LipLine::plain(double x) const {
    const double s = std::min(1.0, std::abs(across(x)));
    const Vec3& corner = x < middle_.x() ? right_ : left_;
    Vec3 p = middle_ + s * s * (corner - middle_);
    p.x() = x;
    return p;
}

}  // namespace risorius::rig
