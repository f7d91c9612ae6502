// SPDX-License-Identifier: MIT
/// \file
/// Electromyograms as a source of excitation: the "emg" of a script.
///
///   {"file": "emg.csv", "rate_hz": 1000, "channels": {"zygomaticus_major.l": "ZYG_L"}}
///
/// Each channel is filtered (signal/emg_envelope.h). Then its resting value is subtracted, and the result is divided by its
/// maximum and clamped to 0..1:
///
///   e = (envelope - rest) / (maximum - rest)      u = e; for a muscle with resting tone that can be reduced, which is
///                                                 silent at u = min: min + (1 - min) e
///
/// Several channels that drive one muscle are added, and so are other sources in the script.
#pragma once

#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/track/channels.h"
#include "risorius/track/script.h"

namespace risorius::track {

/// The "emg" of a script as read.
struct EmgTracks {
    std::vector<EmgTrack> tracks;
    std::vector<std::string>
        notes;  ///< values that were missing; a recording that goes on after the script
};

/// Reads "emg" and its recordings. Keys, ranges and defaults are in docs/formats/script.md. Throws Error that names the script,
/// or file, line and column of the recording; also when the recording lies outside of the script from 0 to `duration_s`.
EmgTracks read_emg(const JsonCursor& json, const ChannelTable& channels, double duration_s);

}  // namespace risorius::track
