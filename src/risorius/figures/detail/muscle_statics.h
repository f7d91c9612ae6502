// SPDX-License-Identifier: MIT
/// \file
/// Kind "muscle-statics": the tension of a muscle at rest over its length, without and with activation, against the
/// one-dimensional equilibrium of fibre and tendon; the thesis' figures 10 and 11a, and what a parameter does to both.
///
///   "muscle": {...}, "runs": [{"name": "cells", "label": "cells", "change": {...}, "at": 10}],
///   "lengths": [0.5, 0.6, 0.7] or {"from": 0.5, "to": 1.6, "step": 0.05}, "activation": 1,
///   "pictures": [{"run": "cells", "length": 0.75, "activation": 1, "picture": "muscle", "caption": "..."}],
///   "range_above_peak": 0.5, "over": "pennation (degrees)", "load_f0": 0.3
///
/// Lengths are normalised, (distance of the plates - lTs) / l0. Each is an equilibrium, passive and active; active force is
/// the difference. Pictures that follow each other under one "picture" stand side by side. Measured per run and length, where
/// "line_" is the one-dimensional equilibrium: total_f0/<run>/<length>, passive_f0/.., active_f0/.., line_active_f0/..,
/// volume_change_percent/.., bulge/.. (width of the middle over that at rest), segment_spread/.. (of the segments of a chain,
/// over l0), all of the active muscle; per run line_error_f0/<run> (greatest of active force), peak_f0/<run>,
/// peak_length/<run>, range/<run> (of lengths whose active force is above that share of the peak), unconverged/<run>.
///
/// With "over" the runs are charted over the number each has "at"; with "load_f0" each also lifts that weight
/// (muscle_release.h): speed/<run>, of the weight as its fibres pass l0, over vmax l0.
#pragma once

#include "risorius/figures/detail/experiment_kind.h"

namespace risorius::figures {

void run_muscle_statics(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome);

}  // namespace risorius::figures
