// SPDX-License-Identifier: MIT
/// \file
/// Kind "contact": soft bodies on rigid obstacles and on each other, drawn at the end of their run, and Coulomb's law of friction
/// measured on a slope.
///
///   "integrator": {...}, "scenes": [{...}],                                   see contact_scene.h
///   "slope": {"body": {...}, "contact": {...}, "degrees": [10, 20, ...], "from_s": 0.4, "to_s": 0.8,
///             "runs": [{"name": "explicit", "label": "...", "integrator": {...}, "slip_speed_m_per_s": 0.01}]}
///
/// Measures per scene: support_ratio/<name> (vertical force of the obstacles over the total weight), load_ratio/<name> (in scenes
/// of several bodies: force of the others on the first over the weight of the others), min_gap_m/<name>, speed_m_per_s/<name> and
/// diverged/<name>. Measure of the slope: acceleration_error_percent/<run>, the maximum difference from Coulomb's law over g. The
/// plane stays at z = 0 and gravity is tilted, so only the magnitude of the body's own gravity counts.
#pragma once

#include "risorius/figures/detail/experiment_kind.h"

namespace risorius::figures {

void run_contact_scenes(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome);

}  // namespace risorius::figures
