// SPDX-License-Identifier: MIT
/// \file
/// Kind "muscle-statics": the isometric tension of a muscle over its length, passive and active, compared with the
/// one-dimensional equilibrium of fibre and tendon. Makes figures 10 and 11a of the thesis (see registry.h), and shows the effect
/// of a parameter on the two tensions.
///
///   "muscle": {...}, "runs": [{"name": "cells", "label": "cells", "change": {...}, "at": 10}],
///   "lengths": [0.5, 0.6, 0.7] or {"from": 0.5, "to": 1.6, "step": 0.05}, "activation": 1,
///   "pictures": [{"run": "cells", "length": 0.75, "activation": 1, "picture": "muscle", "caption": "..."}],
///   "range_above_peak": 0.5, "over": "pennation (degrees)", "load_f0": 0.3
///
/// Lengths are normalised, see muscle_runs.h. At each length, the equilibria of the passive and of the active muscle are
/// computed; the active force is the difference of their tensions. Consecutive pictures with the same "picture" stand side by
/// side. Measures per run and length, of the active muscle, where "line_" marks the one-dimensional equilibrium:
/// total_f0/<run>/<length>, passive_f0/.., active_f0/.., line_active_f0/.., volume_change_percent/.., bulge/.. (width of the
/// middle over that at rest), segment_spread/.. (Musculotendon::segment_spread()). Measures per run: line_error_f0/<run>
/// (maximum error of the active force), peak_f0/<run>, peak_length/<run>, range/<run> (range of lengths whose active force is
/// above the fraction "range_above_peak" of the peak), unconverged/<run>.
///
/// With "over", charts show the runs over the number "at" of each. With "load_f0", each run also lifts that weight
/// (muscle_release.h): speed/<run> is the speed of the weight as the fibres pass l0, over vmax l0.
#pragma once

#include "risorius/figures/detail/experiment_kind.h"

namespace risorius::figures {

void run_muscle_statics(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome);

}  // namespace risorius::figures
