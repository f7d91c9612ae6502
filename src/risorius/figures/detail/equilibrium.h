// SPDX-License-Identifier: MIT
/// \file
/// Kind "equilibrium": bodies brought to equilibrium and drawn, as in figures 5 and 8 of the thesis (see registry.h).
///
///   "body": {...}, "integrator": {...}, "duration_s": 10,
///   "cases": [{"name": "eta-3x3x3", "caption": "...", "change": {...}, "at": "equilibrium", "picture": "eta"}],
///   "length_along": "a3"
///
/// A body may be a mesh of tetrahedra (softbody/mesh_body.h).
///
/// "at": "rest" draws the undeformed shape. Consecutive cases with the same "picture" stand side by side in it. "length_along"
/// selects the axis along which the length is measured. Measures per case: length_ratio/<name>, drift_ratio/<name>,
/// volume_change_percent/<name>, greatest_move_m/<name> (largest displacement of a node), force_ratio/<name> (residual force, see
/// settle.h) and diverged/<name> (0 or 1). For a mesh also holding_n/<name>/<k>, the size of the force with which entry k of "fixed" holds the
/// body, and fibre_stretch/<name>/<k>, the mean length of the fibres of its muscle k over their optimal length. For length_ratio and drift_ratio see Extent in body_cases.h.
#pragma once

#include "risorius/figures/detail/experiment_kind.h"

namespace risorius::figures {

void run_equilibrium(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome);

}  // namespace risorius::figures
