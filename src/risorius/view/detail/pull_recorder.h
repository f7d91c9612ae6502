// SPDX-License-Identifier: MIT
/// \file
/// Keeps what a hand does, and makes an entry of "pulls" of a script of it.
#pragma once

#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/track/pull_track.h"

namespace risorius::view {

/// Keys that lie on the straight line between others within this are left out.
inline constexpr double kStraight_mm = 0.05;

/// Returns the keys that are needed to keep all others within `tolerance_mm` of the straight lines between them.
std::vector<track::PullKey> thinned(const std::vector<track::PullKey>& keys, double tolerance_mm);

/// The pull as JSON: times in microseconds, offsets in hundredths of a millimetre.
Json pull_json(const track::PullTrack& track);

}  // namespace risorius::view
