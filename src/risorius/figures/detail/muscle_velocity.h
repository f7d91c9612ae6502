// SPDX-License-Identifier: MIT
/// \file
/// Kind "muscle-velocity": the force of a muscle while it shortens or lengthens, and the speed at which it lifts weights,
/// compared with Hill's law.
///
///   "muscle": {...}, "runs": [{"name": "prototype", "label": "...", "change": {...}}], "activation": 1,
///   "speeds": [-0.5, -0.25, 0.1] and/or "loads_f0": [0.1, 0.3],
///   "reach": 0.1, "at_fibre_length": 1, "steps": 100
///
/// For each of "speeds", the plates are moved apart from equilibrium at a constant speed, in vmax l0 (negative: the muscle
/// shortens). For each of "loads_f0", a weight hangs on the muscle; a stop holds it until the release. Both start at a fibre
/// length "reach" times l0 away from "at_fibre_length" and cover this distance in about "steps" time steps. Force and fibre speed
/// are read as the fibres pass that length, so that inertia and the tendon do not affect them. Measures per run and speed:
/// force_f0/<run>/speed/<speed>, fibre_speed/..; per run and load: the same with <run>/load/<load>. Measures per run:
/// law_error_f0/<run> (maximum difference of the force from the law a fl fv(v) + fp + b v with activation a, active curve fl,
/// velocity curve fv, passive curve fp and damping b); for shortening hill_a_f0/<run> and hill_vmax/<run> (a / F0, and the
/// maximum speed over vmax, of Hill's hyperbola (P + a)(v + b) = const through the points), power/<run> (maximum power, over F0
/// vmax l0) and power_speed/<run> (its speed); missed/<run> (number of releases that did not reach the length or did not
/// converge).
#pragma once

#include "risorius/figures/detail/experiment_kind.h"

namespace risorius::figures {

void run_muscle_velocity(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome);

}  // namespace risorius::figures
