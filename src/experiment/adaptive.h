// Adaptive resolution against uniform refinement: solids of cells at rest, their error and what it costs.
//
//   "integrator": {"method": "quasi-static", "linear": "conjugate", ..}
//   "cases": [{"name": "cube", "caption": "...", "body": {...},          its grid's cells are the roots
//              "push": {"nodes": {...}, "move_m": [0, 0, -0.1]},          nodes held where they are moved; may be left out
//              "watch": {"a3": "first"},                                  the end whose outward move is an answer
//              "uniform_levels": 2,                                       halvings of every cell, each started from the last
//              "refine": {"tolerance": 0.1, "merge_below": 0.02, "deepest_level": 2, "rounds": 4},
//              "reference": {...}}]                                       as "refine"; its last answers are taken for true
//
// Answers: the end's mean move outwards, the force of the push (N), the stored energy (J) and the change of volume. The
// error is the greatest of theirs, in per cent. Work is the multiplications of all linear solves so far, every coarser
// mesh included: the same on any machine.
//
// Measures, per case: difference_percent (adaptive against the finest uniform, the greatest of the answers), work_share
// (all rounds against the finest uniform and those it started from), work_share_of_last (against the finest uniform's own
// solve), work_share_for_equal_error (what an adaptive run needs to be as near the truth as the finest uniform),
// uniform_error_percent, adaptive_error_percent, mass_change_ratio, converged, and the answers of both.
#pragma once

#include "experiment/experiment_kind.h"

namespace risorius::experiment {

void run_adaptive(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome);

}  // namespace risorius::experiment
