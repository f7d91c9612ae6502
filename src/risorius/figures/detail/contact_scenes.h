// SPDX-License-Identifier: MIT
/// \file
/// Kind "contact": soft bodies on rigid things and on each other, drawn at the end of their run, and the law of
/// friction measured on a slope.
///
///   "integrator": {...}, "scenes": [{...}],                                   see contact_scene.h
///   "slope": {"body": {...}, "contact": {...}, "degrees": [10, 20, ...], "from_s": 0.4, "to_s": 0.8,
///             "runs": [{"name": "explicit", "label": "...", "integrator": {...}, "slip_speed_m_per_s": 0.01}]}
///
/// A scene is measured as support_ratio/<name> (vertical force of the obstacles over all weight), load_ratio/<name> (force
/// between the bodies over the weight of all but the first; scenes of several bodies), min_gap_m/<name>, speed_m_per_s/<name>
/// and diverged/<name>. The slope as acceleration_error_percent/<run>: the largest difference from Coulomb's law, over g.
/// Gravity is tilted rather than the plane z = 0, so the body's own gravity gives its size alone.
#pragma once

#include "risorius/figures/detail/experiment_kind.h"

namespace risorius::figures {

void run_contact_scenes(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome);

}  // namespace risorius::figures
