// SPDX-License-Identifier: MIT
/// \file
/// How finely a face is discretised and how exactly it is solved.
#pragma once

#include <string>

#include "risorius/solve/lanes.h"

namespace risorius::face {

/// Default length of a time step, s. Steps have a fixed length, which does not depend on the frame rate of a video.
inline constexpr double kStep_s = 1.0 / 60.0;

/// Resolution of the skin mesh, and effort of the solver. A step consists of equal substeps; each substep is one implicit solve.
struct Quality {
    std::string name;
    int shell_vertices = 800;  ///< vertices of the skin mesh; each carries three nodes
    /// Maximum per substep. Volume muscles add the same number, and so does a jaw that its muscles move.
    int iterations = 6;
    int min_iterations = 0;  ///< iterations before the tolerance may end a substep
    int mouth_passes = 0;    ///< maximum number of extra iterations restricted to the mouth
    /// A substep ends when an iteration moves the nodes by less than this, RMS, m; 0: never.
    double tolerance_rms_m = 0.0;
    double step_s = kStep_s;  ///< length of a step, s
    /// Maximum length of a substep, s. A step has as few substeps as this allows.
    double max_substep_s = kStep_s;
    solve::Precision precision = solve::Precision::kSingle;  ///< of tissue forces in time steps
};

/// The named qualities:
/// - "draft": steps of 1/30 s with 8 iterations and 10 mouth passes. Its results are twice as far from converged steps as those
///   of "preview".
/// - "preview": 6 iterations and 9 mouth passes. It runs in real time.
/// - "video": two substeps per step, each with at least 4 iterations, until an iteration moves the nodes by less than
///   0.0025 mm RMS.
/// - "fine": as "video", with 1,700 skin vertices.
/// Throws Error for an unknown name.
Quality quality_named(const std::string& name);

}  // namespace risorius::face
