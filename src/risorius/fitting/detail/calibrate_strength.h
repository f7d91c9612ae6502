// SPDX-License-Identifier: MIT
/// \file
/// Finds the strength of every muscle of a head. With this strength, activation 1 shortens the muscle to the published length
/// ratio.
///
///   s   strength: force over the force that follows from the cross-section, [0.1, 6]
///   l   mean fibre length over rest length at activation 1
///
/// The targets of l are "shortens_to" of the muscle bands.
#pragma once

#include <string>
#include <vector>

#include "risorius/core/progress_monitor.h"
#include "risorius/face/face_team.h"
#include "risorius/rig/rig_description.h"

namespace risorius::fitting {

/// The strength found for a muscle.
struct MuscleStrength {
    std::string muscle;
    double strength = 1;
    double stretch = 1;  ///< l that was reached
    double target_stretch = 1;
    bool at_limit = false;  ///< whether the target needs a strength outside the limits
    bool converged = true;  ///< whether the last trial reached equilibrium
};

/// Calibrates the muscles of the rig's bands, each alone while the others have the strengths of the rig, by the secant method. A muscle
/// may be a bundle of fibres or a solid. All faces keep the strengths that were found. Throws Interrupted when the monitor asks to
/// stop.
std::vector<MuscleStrength> calibrate_strength(face::FaceTeam& team, const rig::RigDescription& rig,
                                               const ProgressMonitor& monitor);

}  // namespace risorius::fitting
