// SPDX-License-Identifier: MIT
/// \file
/// Kind "muscle-history": the response of a muscle over time while it is activated and its plates move. The plates are the rigid
/// ends to which the muscle is attached. Makes figure 11b of the thesis (see registry.h), a quick release, and series of twitches
/// that fuse to a tetanus.
///
///   "muscle": {...}, "phases": [{"until_s": 0.2, "step_s": 0.01}, {"until_s": 0.5, "step_s": 1e-3}],
///   "drive": {...}, "length": [[0, 1], ...],                     see muscle_drive.h; a run may replace both
///   "runs": [{"name": "v-10", "label": "10 l0/s", "change": {...}, "drive": {...}, "length": [...],
///             "mark": "line"}],                                    or "dashed": the style of its curves
///   "release_s": 0.2,
///   "shows": [{"quantity": "tension", "name": "recovery", "from_s": 0.19, "to_s": 0.3}]
///
/// Quantities are "tension" (over F0), "activation", "fibre-length" (over l0) and "volume" (its change, %). The motion starts in
/// equilibrium. Measures per run: peak_f0/<run>, peak_time_s/.., final_f0/.., volume_change_percent/.. (maximum).
/// With "release_s": before_f0/.., least_f0/.. (minimum after the release), t50_s/.., t90_s/.. (time from the release until 50 %
/// and 90 % of the final force are regained).
/// With pulses: contraction_s/.. (from the first pulse to the peak), half_relaxation_s/.. (from the peak to half of it),
/// peak_activation/.., activation_half_s/.. (from the peak of activation to half of it),
/// fusion/.. (ratio of the minimum to the maximum force in the last interval between pulses; 1 is a smooth tetanus), mean_f0/..
/// (of that interval). Always: unconverged/<run> (0 or 1).
#pragma once

#include "risorius/figures/detail/experiment_kind.h"

namespace risorius::figures {

void run_muscle_history(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome);

}  // namespace risorius::figures
