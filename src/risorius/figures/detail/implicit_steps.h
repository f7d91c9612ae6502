// SPDX-License-Identifier: MIT
/// \file
/// Kind "implicit-steps": the largest time step at which an implicit method still reproduces the motion of a body, at several
/// resolutions. Makes the table of section 5.4 of the thesis (see registry.h).
///
///   "body": {...}, "grids": [[7, 7], [9, 9], [11, 11]], "duration_s": 10, "allowed_error": 0.05,
///   "steps": {"longest_s": 5, "shortest_s": 2e-3, "per_decade": 12},
///   "rest": {"integrator": {...}, "duration_s": 60},
///   "methods": [{"name": "lagged", "label": "...", "integrator": {"method": "terzopoulos", "lag_rate": true},
///                "change": {...}, "published_s": [0.0325, 0.0292, 0.026]}],
///   "ratios": [["newton", "lagged"]]
///
/// Implicit methods do not diverge, but become inaccurate; the author of the thesis judged this by eye. Here the position of
/// every node is averaged over the second half of the motion. A step is accepted when each average is within "allowed_error"
/// times the body's length of the position in equilibrium. "rest" describes how the equilibrium is computed. Steps are tried from
/// the largest down. Measures: step_s/<method>/<grid>, the largest accepted step (0: no step is accepted), and
/// ratio/<method>/<method>/<grid>, its ratio between the two methods of an entry of "ratios".
#pragma once

#include "risorius/figures/detail/experiment_kind.h"

namespace risorius::figures {

void run_implicit_steps(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome);

}  // namespace risorius::figures
