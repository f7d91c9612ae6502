// SPDX-License-Identifier: MIT
/// \file
/// Finds, for one head, the strength of every muscle with which activation 1 shortens it as published.
///
///   s   strength: force / force from the cross-section, ratio, [0.1, 6]
///   l   mean fibre length / rest length at activation 1
///
/// Targets for l are those of the muscle bands, "shortens_to".
#pragma once

#include <string>
#include <vector>

#include "risorius/core/progress_monitor.h"
#include "risorius/face/face.h"
#include "risorius/rig/rig_description.h"

namespace risorius::fitting {

struct MuscleStrength {
    std::string muscle;
    double strength = 1;
    double stretch = 1;  ///< l reached
    double target_stretch = 1;
    bool at_limit = false;  ///< the strength that the target needs is outside of the limits
    bool converged = true;  ///< the face reached equilibrium in the last trial
};

/// Calibrates each muscle of the rig's bands alone, bundle or solid, one after the other, by the secant method. `face` is left with the
/// strengths found. Throws Interrupted.
std::vector<MuscleStrength> calibrate_strength(face::Face& face, const rig::RigDescription& rig,
                                               const ProgressMonitor& monitor);

}  // namespace risorius::fitting
