// SPDX-License-Identifier: MIT
#include "risorius/track/pull_track.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

namespace risorius::track {

namespace {

PullTrack read_pull(const JsonCursor& json, double longest_s) {
    json.allow_keys({"vertex", "stiffness_n_per_m", "keys_mm"});
    PullTrack track;
    track.vertex = json.at("vertex").integer(0, std::numeric_limits<int>::max());
    if (const auto v = json.find("stiffness_n_per_m"))
        track.stiffness_n_per_m = v->number({kMinPull_n_per_m, kMaxPull_n_per_m});
    const JsonCursor keys = json.at("keys_mm");
    for (const JsonCursor& item : keys.items()) {
        if (!item.is_array() || item.json().size() != 2) item.fail("a key [time_s, [x, y, z]]");
        const std::vector<JsonCursor> pair = item.items();
        const double time_s = pair[0].number({0, longest_s});
        if (!track.keys_mm.empty() && time_s <= track.keys_mm.back().time_s)
            pair[0].fail("a time after " + format_number(track.keys_mm.back().time_s) + " s");
        const Vec3 offset_mm = pair[1].vec3();
        if (!(offset_mm.norm() <= kFarthestPull_mm))
            pair[1].fail("an offset of at most " + format_number(kFarthestPull_mm) + " mm");
        track.keys_mm.push_back({time_s, offset_mm});
    }
    if (track.keys_mm.empty()) keys.fail("at least one key [time_s, [x, y, z]]");
    return track;
}

}  // namespace

std::vector<PullTrack> read_pulls(const JsonCursor& json, double longest_s) {
    std::vector<PullTrack> tracks;
    for (const JsonCursor& item : json.items()) tracks.push_back(read_pull(item, longest_s));
    return tracks;
}

std::vector<Pull> pulls_at(const std::vector<PullTrack>& tracks, double t_s) {
    // Steps end at multiples of 1/60 s, which files have in microseconds.
    constexpr double kNear_s = 1e-6;
    std::vector<Pull> pulls;
    for (const PullTrack& track : tracks) {
        const std::vector<PullKey>& keys = track.keys_mm;
        if (t_s < keys.front().time_s - kNear_s || t_s > keys.back().time_s + kNear_s) continue;
        const auto after = std::find_if(keys.begin(), keys.end(),
                                        [&](const PullKey& key) { return key.time_s > t_s; });
        Vec3 offset_mm = keys.back().offset_mm;
        if (after == keys.begin()) {
            offset_mm = after->offset_mm;
        } else if (after != keys.end()) {
            const PullKey& from = *(after - 1);
            const double part = (t_s - from.time_s) / (after->time_s - from.time_s);
            offset_mm = from.offset_mm + part * (after->offset_mm - from.offset_mm);
        }
        pulls.push_back({track.vertex, 1e-3 * offset_mm, track.stiffness_n_per_m});
    }
    return pulls;
}

}  // namespace risorius::track
