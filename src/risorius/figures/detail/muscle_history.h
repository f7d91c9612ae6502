// SPDX-License-Identifier: MIT
/// \file
/// Kind "muscle-history": what a muscle does over time while it is activated and its plates are moved; the thesis' figure 11b
/// (quick release), and twitches that fuse to a tetanus.
///
///   "muscle": {...}, "phases": [{"until_s": 0.2, "step_s": 0.01}, {"until_s": 0.5, "step_s": 1e-3}],
///   "drive": {...}, "length": [[0, 1], ...],                     muscle_drive.h; a run may have its own of both
///   "runs": [{"name": "v-10", "label": "10 l0/s", "change": {...}, "drive": {...}, "length": [...],
///             "mark": "line"}],                                    or "dashed", of its curves
///   "release_s": 0.2,
///   "shows": [{"quantity": "tension", "name": "recovery", "from_s": 0.19, "to_s": 0.3}]
///
/// Quantities are "tension" (over F0), "activation", "fibre-length" (over l0) and "volume" (its change, %). Motion begins at
/// equilibrium. Measured per run: peak_f0/<run>, peak_time_s/.., final_f0/.., volume_change_percent/.. (greatest);
/// where there is a "release_s": before_f0/.., least_f0/.. (after it), t50_s/.., t90_s/.. (from the release until half and
/// nine tenths of the final force are back); where there are pulses: contraction_s/.. (from the first of them to the peak),
/// half_relaxation_s/.. (from the peak to half of it), fusion/.. (the least over the greatest force of the last interval
/// between pulses; 1 is a smooth tetanus), mean_f0/.. (of that interval); unconverged/<run> (0 or 1).
#pragma once

#include "risorius/figures/detail/experiment_kind.h"

namespace risorius::figures {

void run_muscle_history(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome);

}  // namespace risorius::figures
