// SPDX-License-Identifier: MIT
/// \file
/// Kind "muscle-curves": published sets of a muscle's force curves side by side, with the table of Zajac and Delp as points.
///
///   "sets": [{"name": "thelen", "label": "Thelen 2003", "curves": "thelen2003"}],           muscle/curve_sets.h
///   "at": {"active": [0.5, 1.2], "passive": [1.4], "velocity": [-0.5, 0.1], "tendon": [0.02]}
///
/// Measured per set: value/<set>/<curve>/<x> where "at" asks for it; table_distance/<set>/<curve> (greatest from the
/// points of the table, of the active, the passive and the shortening part of the velocity curve); slope_jump/<set>/<curve>
/// (greatest where pieces meet).
#pragma once

#include "risorius/figures/detail/experiment_kind.h"

namespace risorius::figures {

void run_muscle_curves(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome);

}  // namespace risorius::figures
