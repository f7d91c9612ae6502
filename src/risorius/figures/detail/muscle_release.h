// SPDX-License-Identifier: MIT
/// \file
/// A muscle let go from equilibrium, at a speed or against a weight, until its fibres pass a length; and Hill's hyperbola through
/// what it did there.
#pragma once

#include <vector>

#include "risorius/figures/detail/muscle_motion.h"

namespace risorius::figures {

struct ReleaseBench {
    double activation = 1;
    double reach = 0.1;          ///< how far before that length it begins, l0        (0, 0.5]
    double at_fibre_length = 1;  ///< over l0
    int steps = 100;             ///< to get there, about
};

/// Force and speed of the fibres as they pass the length.
struct Passing {
    double force_f0 = 0;     ///< of the tendons
    double speed = 0;        ///< over vmax l0, less than 0 shortens
    double plate_speed = 0;  ///< of the insertion, over vmax l0
    bool found = false;
    MuscleMotion motion;
};

/// Plates that part evenly, vmax l0 per s.
Passing released_at_speed(const softbody::MuscleDescription& muscle, const ReleaseBench& bench,
                          double speed, const RunOptions& options);

/// A weight, in F0.
Passing released_with_load(const softbody::MuscleDescription& muscle, const ReleaseBench& bench,
                           double load_f0, const RunOptions& options);

/// (P + a)(v + b) = (F0 + a) b of shortening muscles by least squares, P in F0, v > 0 in vmax l0.
struct Hill {
    double a_f0 = 0, max_speed = 0;
};
Hill hill_through(const std::vector<double>& force_f0, const std::vector<double>& speed);

}  // namespace risorius::figures
