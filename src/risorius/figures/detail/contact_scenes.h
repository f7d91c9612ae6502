// SPDX-License-Identifier: MIT
/// \file
/// Kind "contact": soft bodies fall on rigid obstacles and on each other and are drawn at the end of the run. The kind also
/// measures Coulomb's law of friction on a slope.
///
///   "integrator": {...}, "scenes": [{...}],                                   see contact_scene.h
///   "slope": {"body": {...}, "contact": {...}, "degrees": [10, 20, ...], "from_s": 0.4, "to_s": 0.8,
///             "runs": [{"name": "explicit", "label": "...", "integrator": {...}, "slip_speed_m_per_s": 0.01}]}
///
/// Measures per scene: support_ratio/<name> (vertical force of the obstacles over the total weight), load_ratio/<name> (in scenes
/// of several bodies: vertical force of the other bodies on the first one over the weight of the other bodies),
/// least_gap_m/<name> (smallest gap; negative: penetration), speed_m_per_s/<name> (largest speed of a node) and diverged/<name>
/// (0 or 1). Measure of the slope: acceleration_error_percent/<run>, the maximum difference of the acceleration from Coulomb's
/// law over g. The plane stays at z = 0 and gravity is tilted, so the direction of the body's gravity in the file has no effect.
#pragma once

#include "risorius/figures/detail/experiment_kind.h"

namespace risorius::figures {

void run_contact_scenes(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome);

}  // namespace risorius::figures
