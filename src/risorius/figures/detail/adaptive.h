// SPDX-License-Identifier: MIT
/// \file
/// Kind "adaptive": adaptive refinement of the grid of a solid compared with uniform refinement. Measures the error of the
/// equilibrium and the cost of computing it.
///
///   "integrator": {"method": "quasi-static", "linear": "conjugate", ..}
///   "cases": [{"name": "cube", "caption": "...", "body": {...},          the cells of its grid are the coarsest
///              "push": {"nodes": {...}, "move_m": [0, 0, -0.1]},          optional: nodes that are moved and held
///              "watch": {"a3": "first"},                                  the end whose outward displacement is an answer
///              "uniform_levels": 2,                                       number of halvings; each solve starts from the previous one
///              "refine": {"tolerance": 0.1, "merge_below": 0.02, "deepest_level": 2, "rounds": 4},
///              "reference": {...}}]                                       as "refine"; its last answers are the reference
///
/// There are three answers: the mean outward displacement of the watched end (m), the force of the push (N) and the volume. The
/// error of a mesh is the largest relative difference of its answers from those of the reference, in per cent. Work is counted in
/// two ways, as the number of cell Hessians assembled and as the number of matrix products of the conjugate gradients, coarser
/// meshes included. So it is the same on any machine. A ratio of two works is the larger one of the two ratios of these numbers.
/// A mesh that will be refined again is solved until Newton's method moves no node by more than 1/1000 of the body's length.
///
/// Measures per case: difference_percent (the last adaptive mesh against the finest uniform one, maximum over the answers),
/// energy_difference_percent (of the stored energy), work_share (work of all adaptive rounds over that of the whole uniform
/// series), work_share_of_last (work of all adaptive rounds over that of the finest uniform mesh alone), uniform_error_percent,
/// adaptive_error_percent, mass_change_ratio, converged, and the answers of both.
#pragma once

#include "risorius/figures/detail/experiment_kind.h"

namespace risorius::figures {

/// Throws Error for a wrong experiment file.
void run_adaptive(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome);

}  // namespace risorius::figures
