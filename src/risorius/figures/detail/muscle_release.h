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
    /// The release starts at a fibre length this far, in l0, from at_fibre_length        (0, 0.5]
    double reach = 0.1;
    double at_fibre_length = 1;  ///< fibre length at which force and speed are read, over l0
    int steps = 100;             ///< approximate number of time steps until then
};

/// Force and speed of the fibres as they pass the length ReleaseBench::at_fibre_length.
struct Passing {
    double force_f0 = 0;     ///< force of the tendons
    double speed = 0;        ///< over vmax l0, negative when shortening
    double plate_speed = 0;  ///< of the insertion, over vmax l0
    bool found = false;
    MuscleMotion motion;
};

/// Moves the plates apart with a constant speed, in vmax l0; a negative speed brings them together.
Passing released_at_speed(const softbody::MuscleDescription& muscle, const ReleaseBench& bench,
                          double speed, const RunOptions& options);

/// Hangs a weight of `load_f0` times F0 on the muscle.
Passing released_with_load(const softbody::MuscleDescription& muscle, const ReleaseBench& bench,
                           double load_f0, const RunOptions& options);

/// Hill's hyperbola (P + a)(v + b) = (F0 + a) b for shortening, with the tension P in F0, the speed v > 0 in vmax l0, and
/// constants a and b. It is fitted by least squares. max_speed is v at P = 0.
struct Hill {
    double a_f0 = 0, max_speed = 0;
};
Hill hill_through(const std::vector<double>& force_f0, const std::vector<double>& speed);

}  // namespace risorius::figures
