// SPDX-License-Identifier: MIT
/// \file
/// Finds the strength of every muscle of a head with which activation 1 shortens the muscle by the published ratio.
///
///   s   strength: force over the force from the cross-section, [0.1, 6]
///   l   mean fibre length over rest length at activation 1
///
/// The targets of l are "shortens_to" of the muscle bands.
#pragma once

#include <string>
#include <vector>

#include "risorius/core/progress_monitor.h"
#include "risorius/face/face.h"
#include "risorius/rig/rig_description.h"

namespace risorius::fitting {

/// The strength found for a muscle.
struct MuscleStrength {
    std::string muscle;
    double strength = 1;
    double stretch = 1;  ///< l as reached
    double target_stretch = 1;
    bool at_limit = false;  ///< whether the target needs a strength outside the limits
    bool converged = true;  ///< whether the last trial reached equilibrium
};

/// Calibrates each muscle of the rig's bands separately, bundle or solid, one after the other, by the secant method. `face` keeps
/// the strengths found. Throws Interrupted.
std::vector<MuscleStrength> calibrate_strength(face::Face& face, const rig::RigDescription& rig,
                                               const ProgressMonitor& monitor);

}  // namespace risorius::fitting
