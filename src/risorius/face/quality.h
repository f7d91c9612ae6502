// SPDX-License-Identifier: MIT
/// \file
/// How finely a face is discretised and how exactly it is solved.
#pragma once

#include <string>

#include "risorius/solve/lanes.h"

namespace risorius::face {

/// Length of a time step, s. Steps have a fixed length, which does not depend on the frame rate of a video.
inline constexpr double kStep_s = 1.0 / 60.0;

/// A step consists of equal substeps; each substep is one implicit solve.
struct Quality {
    std::string name;
    int shell_vertices = 800;  ///< vertices of the skin mesh; each carries three nodes
    int iterations = 6;      ///< maximum per substep; volume muscles add as many, and so does a jaw
                             ///< that its muscles move
    int min_iterations = 0;  ///< before the tolerance may end a substep
    int mouth_passes = 0;    ///< maximum number of extra iterations restricted to the mouth
    double tolerance_rms_m =
        0.0;  ///< ends a substep when an iteration moves the nodes less, RMS; 0: never
    double step_s = kStep_s;
    double max_substep_s =
        kStep_s;  ///< a step is divided into so many substeps that none is longer
    solve::Precision precision = solve::Precision::kSingle;  ///< of tissue forces in time steps
};

/// The named qualities:
/// - "draft": steps of 1/30 s with 8 iterations and 10 mouth passes. Its error is twice that of "preview".
/// - "preview": 6 iterations and 9 mouth passes, real time.
/// - "video": two substeps per step, each with at least 4 iterations, until an iteration moves the nodes by less than
///   0.0025 mm RMS.
/// - "fine": as "video", with 1,700 skin vertices.
/// Throws Error for an unknown name.
Quality quality_named(const std::string& name);

}  // namespace risorius::face
