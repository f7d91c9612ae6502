// SPDX-License-Identifier: MIT
#include "risorius/rig/detail/scan_spikes.h"

#include <algorithm>
#include <map>
#include <set>
#include <vector>

namespace risorius::rig {

namespace {

constexpr double kLip_mm = 9;   // distance from the line within which points belong to the lips
constexpr double kJump_mm = 8;  // smallest jump backwards along an edge
// Largest fraction of all vertices; more means that the surface has a mouth
constexpr double kLargest = 0.005;
constexpr int kSweeps = 60;

}  // namespace

Points without_spikes(const Head& head, const LipLine& line, int& count) {
    Points out = head.vertices;
    const auto off = [&](int v) {
        const Vec3 p = head.vertices.row(v).transpose();
        return Vec3(p - line.at(p.x()));
    };
    const auto on_lips = [&](int v) { return off(v).norm() < head.mm(kLip_mm); };

    // Find edges where the surface jumps backwards from the lips.
    std::map<int, std::set<int>> next;
    std::vector<int> open;
    for (long f = 0; f < head.skin.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = head.skin(f, k), b = head.skin(f, (k + 1) % 3);
            next[a].insert(b);
            next[b].insert(a);
            for (const auto& [lip, deep] : {std::pair{a, b}, std::pair{b, a}})
                if (head.vertices(lip, 2) - head.vertices(deep, 2) > head.mm(kJump_mm) &&
                    on_lips(lip) && line.spans(head.vertices(lip, 0)))
                    open.push_back(deep);
        }

    // Collect the points behind these edges.
    std::set<int> spikes;
    while (!open.empty()) {
        const int v = open.back();
        open.pop_back();
        if (on_lips(v) || off(v).z() > -head.mm(kJump_mm) || !spikes.insert(v).second) continue;
        for (int w : next[v]) open.push_back(w);
        if (static_cast<double>(spikes.size()) > kLargest * static_cast<double>(next.size())) {
            count = 0;
            return out;
        }
    }
    count = static_cast<int>(spikes.size());

    // Move the spikes back: first each is set to the mean of its neighbours, then all are smoothed.
    for (int v : spikes) {
        Vec3 sum = Vec3::Zero();
        int known = 0;
        for (int w : next[v])
            if (!spikes.count(w)) {
                sum += head.vertices.row(w).transpose();
                ++known;
            }
        const Vec3 start = known ? Vec3(sum / known) : head.landmark("sto");
        out.row(v) = start.transpose();
    }
    for (int sweep = 0; sweep < kSweeps; ++sweep)
        for (int v : spikes) {
            Vec3 sum = Vec3::Zero();
            for (int w : next[v]) sum += out.row(w).transpose();
            out.row(v) = (sum / static_cast<double>(next[v].size())).transpose();
        }
    return out;
}

}  // namespace risorius::rig
