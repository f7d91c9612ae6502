// SPDX-License-Identifier: MIT
/// \file
/// Kind "muscle-curves": charts of published sets of force curves of muscle (force-length, passive, force-velocity, tendon),
/// together with the tabulated points of Zajac and Delp.
///
///   "sets": [{"name": "thelen", "label": "Thelen 2003", "curves": "thelen2003"}],           muscle/curve_sets.h
///   "at": {"active": [0.5, 1.2], "passive": [1.4], "velocity": [-0.5, 0.1], "tendon": [0.02]}
///
/// Measures per set: value/<set>/<curve>/<x> for every x of "at"; table_distance/<set>/<curve> (maximum difference of the force
/// from the tabulated points, over F0; for the active curve, the passive curve and the shortening part of the velocity curve);
/// slope_jump/<set>/<curve> (maximum jump of the slope where pieces of a curve meet).
#pragma once

#include "risorius/figures/detail/experiment_kind.h"

namespace risorius::figures {

void run_muscle_curves(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome);

}  // namespace risorius::figures
