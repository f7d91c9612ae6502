// SPDX-License-Identifier: MIT
/// \file
/// Adaptive resolution against uniform refinement: solids of cells at rest, their error and what it costs.
///
///   "integrator": {"method": "quasi-static", "linear": "conjugate", ..}
///   "cases": [{"name": "cube", "caption": "...", "body": {...},          its grid's cells are the roots
///              "push": {"nodes": {...}, "move_m": [0, 0, -0.1]},          nodes held where they are moved; may be left out
///              "watch": {"a3": "first"},                                  the end whose outward move is an answer
///              "uniform_levels": 2,                                       halvings of every cell, each started from the last
///              "refine": {"tolerance": 0.1, "merge_below": 0.02, "deepest_level": 2, "rounds": 4},
///              "reference": {...}}]                                       as "refine"; its last answers are taken for true
///
/// Answers: the end's mean move outwards, the force of the push (N) and the change of volume. The
/// error is the greatest of theirs, in per cent. Work is counted in second derivatives of cells and in multiplications of
/// conjugate gradients, every coarser mesh included, and so the same on any machine; its share is the greater one of both
/// counts. Meshes that are refined again are settled until Newton moves no node by 1/1000 of the body's length.
///
/// Measures, per case: difference_percent (adaptive against the finest uniform, the greatest of the answers),
/// energy_difference_percent (of the stored energy), work_share
/// (all rounds against the finest uniform and those it started from), work_share_of_last (against the finest uniform's own
/// solve), uniform_error_percent, adaptive_error_percent, mass_change_ratio, converged, and the answers of both.
#pragma once

#include "risorius/figures/detail/experiment_kind.h"

namespace risorius::figures {

void run_adaptive(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome);

}  // namespace risorius::figures
