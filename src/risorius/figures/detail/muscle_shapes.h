// SPDX-License-Identifier: MIT
/// \file
/// Kind "muscle-shapes": muscles of different shapes, drawn side by side at rest and contracted.
///
///   "muscle": {...}, "runs": [{"name": "ring", "label": "...", "change": {"shape": {"ring": {...}}}, "shortening": 0.2}],
///   "activation": 1
///
/// Each muscle is activated. Then its anchors are brought together by "shortening" times l0 in small steps, each an equilibrium.
/// The picture of a run has its name and shows the muscle at rest and at the end. Measures per run: volume_change_percent/<run>
/// (the value farthest from 0 in all steps), bulge/<run> (width of the middle section over that at rest), stretch/<run> (l / l0,
/// mean over the chains), stretch_difference/<run> (maximum minus minimum over the chains), tension_f0/<run>, unconverged/<run>;
/// for a ring opening_ratio/<run> (enclosed area over that at rest); for a filled surface filled_ratio/<run> (volume of the grid
/// over that of the surface).
#pragma once

#include "risorius/figures/detail/experiment_kind.h"

namespace risorius::figures {

void run_muscle_shapes(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome);

}  // namespace risorius::figures
