// SPDX-License-Identifier: MIT
/// \file
/// Kind "equilibrium": bodies brought to rest and drawn, the thesis' figures 5 and 8.
///
///   "body": {...}, "integrator": {...}, "duration_s": 10,
///   "cases": [{"name": "eta-3x3x3", "caption": "...", "change": {...}, "at": "equilibrium", "picture": "eta"}],
///   "length_along": "a3"
///
/// "at": "rest" draws the case undeformed. Cases that follow each other with one "picture" stand side by side in it. "length_along" measures the length across an axis. A case is measured as
/// length_ratio/<name>, drift_ratio/<name>, volume_change_percent/<name>, max_move_m/<name>, force_ratio/<name> (what
/// is left out of balance) and diverged/<name> (0 or 1).
#pragma once

#include "risorius/figures/detail/experiment_kind.h"

namespace risorius::figures {

void run_equilibrium(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome);

}  // namespace risorius::figures
