// SPDX-License-Identifier: MIT
/// \file
/// Kind "volume-history": how the volume of a body changes when its weight suddenly acts, at several resolutions; the
/// thesis' figures 9a and 9b.
///
///   "body": {...}, "duration_s": 11, "sample_s": 0.01, "shows": "volume",
///   "runs": [{"name": "differences", "label": "differences", "change": {...}, "grids": [3, 4, 5], "integrator": {...},
///             "steps_s": [2e-3, 1e-3, 5e-4]}]
///
/// "steps_s", which may be left out, gives each grid its step. "shows": "volume" charts V, "volume-element-sum" the sum
/// over nodes of dV; both are in the tables. Figures of equal body, runs, duration and samples share one run. Measured,
/// per run and grid, of the volume and with "sum_" before the name of the sum: peak_percent/<name>/<grid>, peak_time_s/.., last_percent/.. (mean of the last tenth of the time),
/// settled_s/.. (from when it stays within 5 % of the peak around that); steps/<name>/<grid>.
#pragma once

#include "risorius/figures/detail/experiment_kind.h"

namespace risorius::figures {

void run_volume_history(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome);

}  // namespace risorius::figures
