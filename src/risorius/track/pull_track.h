// SPDX-License-Identifier: MIT
/// \file
/// A pull over time: a spring between a vertex of the skin and a point that keys move, as the mouse moves it in the thesis.
///
/// Source: M. Dobsik, Computer Animation of Soft Tissues, Brno 2005, section 3.4.
#pragma once

#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/types.h"
#include "risorius/track/channels.h"

namespace risorius::track {

/// The bounds of a pull. A hand that is further off than the largest offset pulls no harder in another direction.
inline constexpr double kMinPull_n_per_m = 1, kMaxPull_n_per_m = 5000, kFarthestPull_mm = 300;

struct PullKey {
    double time_s;
    Vec3 offset_mm;  ///< from the position of the vertex at rest, world frame
};

/// One entry of "pulls" of a script; field names are its keys.
struct PullTrack {
    int vertex = 0;
    double stiffness_n_per_m = Pull{}.stiffness_n_per_m;
    /// At least one. The pull lasts from the first key to the last one; it is linear between them.
    std::vector<PullKey> keys_mm;
};

/// Reads "pulls". Throws Error.
std::vector<PullTrack> read_pulls(const JsonCursor& json, double longest_s);

/// Returns the pulls that are held at a time.
std::vector<Pull> pulls_at(const std::vector<PullTrack>& tracks, double t_s);

}  // namespace risorius::track
