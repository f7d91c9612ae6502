// SPDX-License-Identifier: MIT
/// \file
/// Kind "volume-history": the volume of a body over time, at several resolutions, when its weight acts from the first moment on.
/// Makes figures 9a and 9b of the thesis (see registry.h).
///
///   "body": {...}, "duration_s": 11, "sample_s": 0.01, "shows": "volume",
///   "runs": [{"name": "differences", "label": "differences", "change": {...}, "grids": [3, 4, 5], "integrator": {...},
///             "steps_s": [2e-3, 1e-3, 5e-4]}]
///
/// The optional "steps_s" is a list of time steps, one for each grid. "shows" selects what the chart shows: "volume" is the
/// volume V of the body, "volume-element-sum" is the sum over nodes of their volume elements dV. The tables have both. Figures
/// with equal body, runs, duration and samples share one run. Values are changes since rest, in per cent. The following are
/// measured per run and grid, for the volume, and with the prefix "sum_" for the sum: peak_percent/<name>/<grid>, peak_time_s/..,
/// last_percent/.. (mean over the last tenth of the time), settled_s/.. (the time after which the value differs from that mean by
/// at most 5 % of the peak). In addition: steps/<name>/<grid>, the number of time steps, and for each two grids of a run of which one has half the spacing of
/// the other extrapolated_percent/<name>/<coarse>-<fine>, the limit of last_percent if its error falls with the square of the
/// spacing.
#pragma once

#include "risorius/figures/detail/experiment_kind.h"

namespace risorius::figures {

void run_volume_history(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome);

}  // namespace risorius::figures
