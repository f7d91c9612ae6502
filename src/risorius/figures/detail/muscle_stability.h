// SPDX-License-Identifier: MIT
/// \file
/// Kind "muscle-stability": the longest step of a table with which a method gets through Zajac's tension-length experiment,
/// over the number of nodes; the thesis' figure 12b.
///
///   "muscle": {... as softbody::read_muscle, without "grid"}, "nodes_per_edge": [3, 4, 5],
///   "activation": 1, "lengthening_m": 0.002, "duration_s": 0.1,
///   "methods": ["euler", "rk4"], "steps": {"longest_s": 1e-2, "shortest_s": 1e-6, "per_decade": 12}, "diverged_at": 1,
///   "longer": {"nodes_per_edge": [3], "duration_s": 7.5},
///   "linear_theory": {"nodes_per_edge": [3, 4]},
///   "tension": {"nodes_per_edge": 3, "method": "rk4", "shortest_s": 1e-6, "duration_s": 0.1}
///
/// The muscle starts at rest, with that activation from t = 0 and its plates "lengthening_m" farther apart than at rest.
/// Measured: step_s/<method>/<nodes>; exponent/<method> of step ~ nodes^exponent by least squares of the logarithms; and
/// ratio/<method>/<next method>, a geometric mean over the grids. "longer" repeats the search with another duration:
/// longer_step_s/.. and longer_table_steps/.., by how many steps of the table the limit falls. "linear_theory" gives
/// linear_s/.., the longest step with which small motions about rest die away. "tension" looks between the two, where a
/// motion neither diverges nor is right: the mean pull over F0 of the second half at every step down to "shortest_s" as
/// tension_finest_f0, tension_at_longest_step_f0 and step_of_right_tension_s, the longest within 1 % of the finest.
#pragma once

#include "risorius/figures/detail/experiment_kind.h"

namespace risorius::figures {

void run_muscle_stability(const JsonCursor& experiment, const RunOptions& options,
                          Outcome& outcome);

}  // namespace risorius::figures
