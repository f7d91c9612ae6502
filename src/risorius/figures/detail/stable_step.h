// SPDX-License-Identifier: MIT
/// \file
/// Kind "stable-step": the largest stable time step of a method in a simulation, as a function of one parameter. Makes figure 12a
/// of the thesis (see registry.h).
///
///   "body": {...}, "duration_s": 7.5, "methods": ["euler", "rk4"],
///   "varied": {"name": "omega", "unit": "N s/m^3", "pointer": "/material/damping_ns_per_m3", "values": [0.01, 0.1, 1]},
///   "steps": {"longest_s": 1e-2, "shortest_s": 1e-5, "per_decade": 12}, "diverged_at": 1000
///
/// As in the thesis, steps are tried from the largest down. The result is the first one at which the motion does not diverge; 0:
/// there is none. Measures: step_s/<method>/<value>, predicted_s/.. (by linear theory about the rest state), ratio/.. of the two.
#pragma once

#include "risorius/figures/detail/experiment_kind.h"

namespace risorius::figures {

void run_stable_step(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome);

}  // namespace risorius::figures
