// SPDX-License-Identifier: MIT
/// \file
/// Kind "static-resolution": how the equilibrium of a body under its weight depends on resolution and discretisation. Compares
/// the finite differences of the thesis (see registry.h) with trilinear cells.
///
///   "body": {...}, "length_along": "a3", "duration_s": 10,
///   "runs": [{"name": "cells", "label": "B, psi_c = 100", "change": {...}, "grids": [3, 5, 9], "integrator": {...}}]
///
/// The optional "steps_s" of a run is a list of time steps, one for each grid. Measures per run and grid:
/// length_ratio/<name>/<grid> and drift_ratio/.. (see Extent in body_cases.h), volume_change_percent/.., force_ratio/.. (residual
/// force, see settle.h), linear_solves/.. (their number). Measure per run: length_spread_percent/<name>, (maximum - minimum) /
/// mean of the lengths.
#pragma once

#include "risorius/figures/detail/experiment_kind.h"

namespace risorius::figures {

void run_static_resolution(const JsonCursor& experiment, const RunOptions& options,
                           Outcome& outcome);

}  // namespace risorius::figures
