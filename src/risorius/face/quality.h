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
    int iterations = 40;       ///< maximum per substep
    int min_iterations = 0;    ///< iterations before the tolerance may end a substep
    int mouth_passes = 0;      ///< maximum number of extra iterations restricted to the mouth
    /// A substep ends when an iteration moves the nodes by less than this, RMS, m; 0: never. For mouth passes it is a tenth.
    double tolerance_rms_m = 0.0;
    double step_s = kStep_s;  ///< length of a step, s
    /// Maximum length of a substep, s. A step has as few substeps as this allows.
    double max_substep_s = kStep_s;
    solve::Precision precision = solve::Precision::kSingle;  ///< of tissue forces in time steps
};

/// The named qualities:
/// - "draft": steps of 1/30 s, each with 4 to 40 iterations, until an iteration moves the nodes by less than 0.02 mm RMS, and
///   up to 6 mouth passes.
/// - "preview": steps of 1/60 s, until an iteration moves the nodes by less than 0.01 mm RMS. It runs in real time.
/// - "video": two substeps per step, each with at least 4 iterations, until an iteration moves the nodes by less than
///   0.0025 mm RMS.
/// - "fine": as "video", with 1,700 skin vertices.
/// Throws Error for an unknown name.
Quality quality_named(const std::string& name);

}  // namespace risorius::face
