// SPDX-License-Identifier: MIT
/// \file
/// Kind "muscle-stability": the largest stable time step of a method in Zajac's tension-length experiment, as a function of the
/// number of nodes. Makes figure 12b of the thesis (see registry.h).
///
///   "muscle": {... as softbody::read_muscle, without "grid"}, "nodes_per_edge": [3, 4, 5],
///   "activation": 1, "lengthening_m": 0.002, "duration_s": 0.1,
///   "methods": ["euler", "rk4"], "steps": {"longest_s": 1e-2, "shortest_s": 1e-6, "per_decade": 12}, "diverged_at": 1,
///   "longer": {"nodes_per_edge": [3], "duration_s": 7.5},
///   "linear_theory": {"nodes_per_edge": [3, 4]},
///   "tension": {"nodes_per_edge": 3, "method": "rk4", "shortest_s": 1e-6, "duration_s": 0.1}
///
/// The muscle starts at rest. From t = 0 it has the given activation, and its plates are "lengthening_m" farther apart than at
/// rest. The steps that are tried are those of the table "steps" (step_search.h). Measures: step_s/<method>/<nodes>;
/// exponent/<method>, the exponent of step ~ nodes^exponent by least squares of the logarithms; ratio/<method>/<next method>, a
/// geometric mean over the grids. "longer" repeats the search with another duration: longer_step_s/.., and longer_table_steps/..,
/// the number of table entries by which the limit falls. "linear_theory" adds linear_s/.., the largest step at which small
/// motions about rest decay. "tension" examines steps at which a motion neither diverges nor is accurate. It measures the mean
/// pull over F0 in the second half for every step down to "shortest_s": tension_finest_f0, tension_at_longest_step_f0 and
/// step_of_right_tension_s, the largest step with an error below 1 % of the finest.
#pragma once

#include "risorius/figures/detail/experiment_kind.h"

namespace risorius::figures {

void run_muscle_stability(const JsonCursor& experiment, const RunOptions& options,
                          Outcome& outcome);

}  // namespace risorius::figures
