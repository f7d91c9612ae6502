// SPDX-License-Identifier: MIT
/// \file
/// A muscle released from equilibrium, at a speed or against a weight, until its fibres pass a given length; and a fit of Hill's
/// hyperbola to the results.
#pragma once

#include <vector>

#include "risorius/figures/detail/muscle_motion.h"

namespace risorius::figures {

/// Conditions of a release.
struct ReleaseBench {
    double activation = 1;
    double reach = 0.1;  ///< distance from that length at which it starts, l0        (0, 0.5]
    double at_fibre_length = 1;  ///< fibre length at which force and speed are read, over l0
    int steps = 100;             ///< approximate number of steps until then
};

/// Force and speed of the fibres as they pass the length.
struct Passing {
    double force_f0 = 0;     ///< force of the tendons
    double speed = 0;        ///< over vmax l0, negative when shortening
    double plate_speed = 0;  ///< of the insertion, over vmax l0
    bool found = false;
    MuscleMotion motion;
};

/// Moves the plates apart with constant speed, in vmax l0.
Passing released_at_speed(const softbody::MuscleDescription& muscle, const ReleaseBench& bench,
                          double speed, const RunOptions& options);

/// Hangs a weight on the muscle, in F0.
Passing released_with_load(const softbody::MuscleDescription& muscle, const ReleaseBench& bench,
                           double load_f0, const RunOptions& options);

/// Hill's hyperbola (P + a)(v + b) = (F0 + a) b for shortening, fitted by least squares; P in F0, v > 0 in vmax l0.
struct Hill {
    double a_f0 = 0, max_speed = 0;
};
Hill hill_through(const std::vector<double>& force_f0, const std::vector<double>& speed);

}  // namespace risorius::figures
