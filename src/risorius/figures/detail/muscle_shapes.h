// SPDX-License-Identifier: MIT
/// \file
/// Kind "muscle-shapes": muscles of every shape at rest and contracted, drawn side by side.
///
///   "muscle": {...}, "runs": [{"name": "ring", "label": "...", "change": {"shape": {"ring": {...}}}, "shortening": 0.2}],
///   "activation": 1
///
/// Each muscle is activated and then its anchors are brought together by "shortening" of l0, in small steps that are all
/// equilibria. Its picture has the name of the run: at rest, and at the end. Measured per run: volume_change_percent/<run> (the
/// farthest from 0 on the way), bulge/<run> (width of the middle section over that at rest), stretch/<run> (l / l0, mean of
/// the chains), stretch_difference/<run> (greatest less least chain), tension_f0/<run>, unconverged/<run>; of a ring
/// opening_ratio/<run> (area within it over that at rest), of a filled surface filled_ratio/<run> (volume of the grid over that
/// of the surface).
#pragma once

#include "risorius/figures/detail/experiment_kind.h"

namespace risorius::figures {

void run_muscle_shapes(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome);

}  // namespace risorius::figures
