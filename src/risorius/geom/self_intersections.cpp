// SPDX-License-Identifier: MIT
#include "risorius/geom/self_intersections.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace risorius::geom {
namespace {

bool segment_cuts(const Vec3& from, const Vec3& to, const Vec3& a, const Vec3& b, const Vec3& c) {
    constexpr double kTouch = 1e-9;
    const Vec3 along = to - from, ab = b - a, ac = c - a;
    const Vec3 across = along.cross(ac);
    const double volume = ab.dot(across);
    if (std::abs(volume) <= kTouch * along.norm() * ab.norm() * ac.norm()) return false;
    const Vec3 start = from - a;
    const double u = start.dot(across) / volume;
    if (u <= kTouch || u >= 1 - kTouch) return false;
    const Vec3 turned = start.cross(ab);
    const double v = along.dot(turned) / volume;
    if (v <= kTouch || u + v >= 1 - kTouch) return false;
    const double t = ac.dot(turned) / volume;
    return t > kTouch && t < 1 - kTouch;
}

}  // namespace

std::vector<std::array<int, 2>> self_intersections(const Points& positions,
                                                   const Triangles& triangles) {
    const int count = static_cast<int>(triangles.rows());
    const auto corner = [&](int t, int k) -> Vec3 {
        return positions.row(triangles(t, k % 3)).transpose();
    };
    Points low(count, 3), high(count, 3);
    for (int t = 0; t < count; ++t) {
        low.row(t) = corner(t, 0).cwiseMin(corner(t, 1)).cwiseMin(corner(t, 2)).transpose();
        high.row(t) = corner(t, 0).cwiseMax(corner(t, 1)).cwiseMax(corner(t, 2)).transpose();
    }
    // Sweep along y. Considers boxes that begin before this one ends, and of those the ones that overlap it.
    std::vector<int> order(static_cast<std::size_t>(count));
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](int a, int b) { return low(a, 1) != low(b, 1) ? low(a, 1) < low(b, 1) : a < b; });
    std::vector<std::array<int, 2>> pairs;
    for (std::size_t i = 0; i < order.size(); ++i) {
        const int s = order[i];
        for (std::size_t j = i + 1; j < order.size() && low(order[j], 1) <= high(s, 1); ++j) {
            const int t = order[j];
            if (low(t, 0) > high(s, 0) || low(s, 0) > high(t, 0) || low(t, 2) > high(s, 2) ||
                low(s, 2) > high(t, 2))
                continue;
            bool joined = false;
            for (int a = 0; a < 3; ++a)
                for (int b = 0; b < 3; ++b) joined |= triangles(s, a) == triangles(t, b);
            if (joined) continue;
            bool cut = false;
            for (int k = 0; k < 3 && !cut; ++k)
                cut = segment_cuts(corner(s, k), corner(s, k + 1), corner(t, 0), corner(t, 1),
                                   corner(t, 2)) ||
                      segment_cuts(corner(t, k), corner(t, k + 1), corner(s, 0), corner(s, 1),
                                   corner(s, 2));
            if (cut) pairs.push_back({std::min(s, t), std::max(s, t)});
        }
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

}  // namespace risorius::geom
