// SPDX-License-Identifier: MIT
/// \file
/// Keeps what a hand does to channels while time runs, and makes keys of it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/track/pull_track.h"
#include "risorius/track/script.h"
#include "risorius/view/document.h"

namespace risorius::view {

/// A curve of keys may be this far from what was recorded, on channels from 0 to 1.
inline constexpr double kThinned = 0.02;

/// The same for any channel: larger ranges (degrees, mm, Pa) are taken as twenty such units.
double thinned_to(double range);

/// Returns the samples that are needed as keys to keep the curve within `tolerance` of all of them. Times must increase.
std::vector<track::Key> thinned_keys(const std::vector<track::Key>& samples, double tolerance,
                                     track::Interpolation interpolation);

/// What has been recorded since recording began.
struct Recording {
    std::map<std::string, std::vector<track::Key>> channels;
    std::vector<track::PullTrack> pulls;
    bool empty() const { return channels.empty() && pulls.empty(); }
};

/// What puts a recording into a script. Keys between its first and its last sample are replaced; before and after, each channel
/// goes on as it was. Times are kept to 0.1 ms, values to 0.001.
std::vector<Operation> recording_edits(const Recording& recording, const Json& script,
                                       const track::ScriptDescription& read);

}  // namespace risorius::view
