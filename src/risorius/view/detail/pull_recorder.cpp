// SPDX-License-Identifier: MIT
#include "risorius/view/detail/pull_recorder.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "risorius/core/json_object.h"

namespace risorius::view {

namespace {

double rounded(double value, double places) { return std::round(value * places) / places + 0.0; }

}  // namespace

// Ramer, Douglas and Peucker: the key that is furthest from the line is kept, and both parts are treated in the same way.
std::vector<track::PullKey> thinned(const std::vector<track::PullKey>& keys, double tolerance_mm) {
    if (keys.size() < 3) return keys;
    std::vector<char> kept(keys.size(), 0);
    kept.front() = kept.back() = 1;
    std::vector<std::pair<std::size_t, std::size_t>> parts{{0, keys.size() - 1}};
    while (!parts.empty()) {
        const auto [from, to] = parts.back();
        parts.pop_back();
        double furthest_mm = tolerance_mm;
        std::size_t at = from;
        for (std::size_t i = from + 1; i < to; ++i) {
            const double part =
                (keys[i].time_s - keys[from].time_s) / (keys[to].time_s - keys[from].time_s);
            const Vec3 straight =
                keys[from].offset_mm + part * (keys[to].offset_mm - keys[from].offset_mm);
            const double off_mm = (keys[i].offset_mm - straight).norm();
            if (off_mm > furthest_mm) {
                furthest_mm = off_mm;
                at = i;
            }
        }
        if (at == from) continue;
        kept[at] = 1;
        parts.emplace_back(from, at);
        parts.emplace_back(at, to);
    }
    std::vector<track::PullKey> out;
    for (std::size_t i = 0; i < keys.size(); ++i)
        if (kept[i]) out.push_back(keys[i]);
    return out;
}

Json pull_json(const track::PullTrack& track) {
    Json keys = Json::array();
    for (const track::PullKey& key : track.keys_mm) {
        const Vec3& p = key.offset_mm;
        keys.push_back({rounded(key.time_s, 1e6),
                        {rounded(p.x(), 100), rounded(p.y(), 100), rounded(p.z(), 100)}});
    }
    return json_object({{"vertex", track.vertex},
                        {"stiffness_n_per_m", track.stiffness_n_per_m},
                        {"keys_mm", keys}});
}

}  // namespace risorius::view
