// SPDX-License-Identifier: MIT
/// \file
/// The channels of a rig as a list for the page, with their ranges, and the curves of a script as the simulation sees them.
#pragma once

#include "risorius/core/json_cursor.h"
#include "risorius/rig/rig_description.h"
#include "risorius/track/script.h"

namespace risorius::view {

/// [{"name": "AU12", "group": "units", "label": "Lip corner puller", "min": 0, "max": 1, "sided": true, "unit": ""}]; groups are
/// "muscles", "units", "jaw", "gaze", "head", "mouth" and "shapes". A sided channel may be driven as name.l and name.r.
Json channel_list(const rig::RigDescription& rig);

/// {"AU12": [0, 0.01, ...]}: kCurveSamples values of each channel of the script, evenly from 0 to its duration.
inline constexpr int kCurveSamples = 240;
Json curve_samples(const track::ScriptDescription& script);

/// {"zygomaticus_major.l": [0, 0.01, ...]}: the excitations of recorded muscle activity (EMG), kRecordedSamples values of each,
/// evenly from 0 to the duration. Recordings of one muscle are added. An empty object without a recording.
inline constexpr int kRecordedSamples = 480;
Json recorded_samples(const track::ScriptDescription& script);

}  // namespace risorius::view
