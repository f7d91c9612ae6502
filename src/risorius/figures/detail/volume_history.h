// SPDX-License-Identifier: MIT
/// \file
/// Kind "volume-history": the volume of a body over time when its weight suddenly acts, at several resolutions; figures 9a and 9b
/// of the thesis.
///
///   "body": {...}, "duration_s": 11, "sample_s": 0.01, "shows": "volume",
///   "runs": [{"name": "differences", "label": "differences", "change": {...}, "grids": [3, 4, 5], "integrator": {...},
///             "steps_s": [2e-3, 1e-3, 5e-4]}]
///
/// The optional "steps_s" gives each grid its time step. "shows" selects the chart: "volume" charts V, "volume-element-sum" the
/// sum over nodes of dV; the tables have both. Figures with equal body, runs, duration and samples share one run. Measures per
/// run and grid, of the volume, and with the prefix "sum_" of the sum: peak_percent/<name>/<grid>, peak_time_s/..,
/// last_percent/.. (mean over the last tenth of the time), settled_s/.. (the time after which the value stays within 5 % of the
/// peak around that mean); steps/<name>/<grid>.
#pragma once

#include "risorius/figures/detail/experiment_kind.h"

namespace risorius::figures {

void run_volume_history(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome);

}  // namespace risorius::figures
