// SPDX-License-Identifier: MIT
/// \file
/// Kind "muscle-velocity": the force a muscle has while it shortens or lengthens, and the speed with which it lifts weights,
/// against Hill's law.
///
///   "muscle": {...}, "runs": [{"name": "prototype", "label": "...", "change": {...}}], "activation": 1,
///   "speeds": [-0.5, -0.25, 0.1] and/or "loads_f0": [0.1, 0.3],
///   "reach": 0.1, "at_fibre_length": 1, "steps": 100
///
/// A speed moves the plates apart evenly, from equilibrium, by vmax l0 (less than 0 shortens); a load hangs a weight on the
/// muscle, which holds it by a stop until it is let go. Both begin `reach` l0 away from where the fibres have
/// "at_fibre_length" and cover it in about "steps" steps. Force and fibre speed are read when the fibres pass that length, so
/// that neither inertia nor the tendon comes between them. Measured per run and speed: force_f0/<run>/speed/<speed>,
/// fibre_speed/..; per run and load: the same of <run>/load/<load>; per run: law_error_f0/<run> (greatest difference of force
/// from a fl fv(v) + fp + b v), and of the shortening ones hill_a_f0/<run>, hill_vmax/<run> (a / F0 and the greatest speed of
/// Hill's hyperbola (P + a)(v + b) = const through them, over vmax), power/<run> (greatest, over F0 vmax l0) and
/// power_speed/<run>; missed/<run> (releases that never got there, or did not converge).
#pragma once

#include "risorius/figures/detail/experiment_kind.h"

namespace risorius::figures {

void run_muscle_velocity(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome);

}  // namespace risorius::figures
