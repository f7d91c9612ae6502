// SPDX-License-Identifier: MIT
/// \file
/// The event codes of a set: which goes out at which frame of which clip.
///
///   1        clip_on, when all clips have the same code
///   2 to 4   movement_onset, apex, clip_off
///   10...250 clip_on, when its code tells the condition
#pragma once

#include <map>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/design/design.h"
#include "risorius/stimuli/detail/clip.h"

namespace risorius::stimuli {

/// Codes of clip_on.
struct CodesOfClips {
    std::map<std::string, int> code_of;  ///< by the name of the clip; empty: all are 1
    std::string table;  ///< codes.tsv: each code, and what it stands for; empty when all are 1
};

/// Gives codes to the clips in their order. Throws Error for a parameter that no clip has, and when there are too few codes.
CodesOfClips codes_of_clips(const std::vector<ClipPlan>& clips, const design::Design& design);

/// A moment of a clip.
struct Trigger {
    std::string event;
    int code = 0, frame = 0;
    double time_s = 0;
    std::string
        merged_into;  ///< the moment of the same frame that has the code; empty: this one has it
};

/// Returns the moments of a clip, from its sidecar. A moment that the clip does not have is missing. Of several moments in one frame, the
/// first has the code.
std::vector<Trigger> triggers_of(const Json& record, const CodesOfClips& codes);

/// Returns the table of all codes. `records`: sidecars.
std::string triggers(const std::vector<Json>& records, const CodesOfClips& codes);

}  // namespace risorius::stimuli
