// SPDX-License-Identifier: MIT
/// \file
/// Kind "static-resolution": what a body at rest under its weight owes to its resolution and to its discretisation; the
/// thesis' finite differences against trilinear cells.
///
///   "body": {...}, "length_along": "a3", "duration_s": 10,
///   "runs": [{"name": "cells", "label": "B, psi_c = 100", "change": {...}, "grids": [3, 5, 9], "integrator": {...}}]
///
/// "steps_s" of a run, which may be left out, gives each grid its step.
/// Measured per run and grid: length_ratio/<name>/<grid>, drift_ratio/.., volume_change_percent/.., force_ratio/.. (what is
/// left out of balance), linear_solves/..; per run: length_spread_percent/<name>, (longest - shortest) / their mean.
#pragma once

#include "risorius/figures/detail/experiment_kind.h"

namespace risorius::figures {

void run_static_resolution(const JsonCursor& experiment, const RunOptions& options,
                           Outcome& outcome);

}  // namespace risorius::figures
