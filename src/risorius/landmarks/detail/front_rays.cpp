// SPDX-License-Identifier: MIT
#include "risorius/landmarks/detail/front_rays.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace risorius::landmarks {

namespace {

constexpr double kDeepest_m = 3e-3;  // of a crease behind the skin that is expected
constexpr double kBefore_m = 25e-3;  // where rays start
constexpr double kBeside_m = 1e-5;
constexpr double kOpen_deg = 180;  // turn where no skin is seen

double outside_of(const ShownHead& head) {
    double sum = 0;
    for (Eigen::Index f = 0; f < head.skin.rows(); ++f) {
        const Vec3 a = head.positions.row(head.skin(f, 0)).transpose(),
                   b = head.positions.row(head.skin(f, 1)).transpose(),
                   c = head.positions.row(head.skin(f, 2)).transpose();
        if (a.z() > 0.05) sum += (b - a).cross(c - a).z();
    }
    return sum < 0 ? -1 : 1;
}

}  // namespace

FrontRays::FrontRays(const ShownHead& head) : head_(head), outside_(outside_of(head)) {}

Sight FrontRays::sight(double x, double y, double z) const {
    // A little beside the midline, on which many meshes have an edge
    const auto hit =
        head_.tree.cast(Vec3(x + kBeside_m, y + kBeside_m, z + kBefore_m), -Vec3::UnitZ());
    if (!hit || head_.part[static_cast<std::size_t>(hit->triangle)] != ShownPart::kSkin) return {};
    const auto corner = [&](int k) -> Vec3 {
        return head_.positions.row(head_.triangles(hit->triangle, k)).transpose();
    };
    const Vec3 normal = outside_ * (corner(1) - corner(0)).cross(corner(2) - corner(0));
    if (!(normal.z() > 0)) return {};  // the inside of the head, through an open lid
    return {true, std::atan2(-normal.y(), normal.z()) * 180 / std::numbers::pi, hit->point};
}

Crease FrontRays::crease(const CreaseSearch& search) const {
    const int around = static_cast<int>(std::lround(search.around_m / kRayStep_m)),
              apart = static_cast<int>(std::lround(kTurnOver_m / kRayStep_m));
    const auto y_of = [&](double row) {
        return search.y + (around + 0.5 * apart - row) * kRayStep_m;
    };
    std::vector<Sight> seen;
    for (int i = 0; i <= 2 * around + apart; ++i)
        seen.push_back(sight(search.x, y_of(i), search.z));
    // Turns of windows of rows, and the one that is greatest for where it is
    std::vector<double> turns;
    int best = 0;
    double most = 0;
    for (int i = 0; i <= 2 * around; ++i) {
        bool open = false;
        for (int k = i; k <= i + apart; ++k) open = open || !seen[static_cast<std::size_t>(k)].skin;
        turns.push_back(open ? kOpen_deg
                             : seen[static_cast<std::size_t>(i)].down_deg -
                                   seen[static_cast<std::size_t>(i + apart)].down_deg);
        const double now = turns.back() - search.deg_per_m * kRayStep_m * std::abs(i - around);
        if (i > 0 && now <= most) continue;
        most = now;
        best = i;
    }
    const auto turn_at = [&](int i) { return turns[static_cast<std::size_t>(i)]; };
    int first = best, last = best;
    while (first > 0 && turn_at(first - 1) >= turn_at(best) - search.flat_deg) --first;
    while (last < 2 * around && turn_at(last + 1) >= turn_at(best) - search.flat_deg) ++last;
    Crease out;
    out.turn_deg = turn_at(best);
    out.y = y_of(0.5 * (first + last + apart));
    double sum = 0;
    Vec3 place = Vec3::Zero();
    for (int i = first; i <= last; ++i) {
        // The deepest skin of the window; teeth that have no part of their own lie behind it.
        const Sight* deepest = nullptr;
        for (int k = i; k <= i + apart; ++k) {
            const Sight& here = seen[static_cast<std::size_t>(k)];
            if (here.skin && here.at.z() > search.z - kDeepest_m &&
                (!deepest || here.at.z() < deepest->at.z()))
                deepest = &here;
        }
        if (!deepest) continue;
        sum += 1;
        place += deepest->at;
    }
    if (sum > 0) out.at = place / sum;
    return out;
}

}  // namespace risorius::landmarks
