// SPDX-License-Identifier: MIT
/// \file
/// Kind "implicit-steps": the longest step with which an implicit method still shows the right motion of a body, at several
/// resolutions; the thesis' table of section 5.4.
///
///   "body": {...}, "grids": [[7, 7], [9, 9], [11, 11]], "duration_s": 10, "allowed_error": 0.05,
///   "steps": {"longest_s": 5, "shortest_s": 2e-3, "per_decade": 12},
///   "rest": {"integrator": {...}, "duration_s": 60},
///   "methods": [{"name": "lagged", "label": "...", "integrator": {"method": "terzopoulos", "lag_rate": true},
///                "change": {...}, "published_s": [0.0325, 0.0292, 0.026]}],
///   "ratios": [["newton", "lagged"]]
///
/// Such methods do not diverge to infinity, they only go wrong; the thesis' author judged by eye. Here a step counts when
/// the mean shape of the second half of the motion lies within `allowed_error` of the body's length of where the body
/// comes to rest ("rest" says how that is found), each node by itself. Steps are tried from the longest down; 0 stands
/// for none. Measured: step_s/<method>/<grid>, ratio/<method>/<method>/<grid>.
#pragma once

#include "risorius/figures/detail/experiment_kind.h"

namespace risorius::figures {

void run_implicit_steps(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome);

}  // namespace risorius::figures
