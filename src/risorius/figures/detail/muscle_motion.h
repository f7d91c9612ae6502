// SPDX-License-Identifier: MIT
/// \file
/// A muscle moved in time by implicit Euler steps and what its plates feel meanwhile: held at lengths that are prescribed, or
/// pulling a weight.
///
///   m x'' = T - W      x   how far the load has come, m      T   tension, N       W   weight of the load, N       m   its mass
///
/// The load and the muscle take turns: the muscle's step ends where the load's speed takes the plate, the tension it ends
/// with is what the load feels (symplectic Euler, stable while h < 2 sqrt(m / k), k the tendons' stiffness).
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "risorius/figures/detail/run_options.h"
#include "risorius/softbody/muscle_body.h"

namespace risorius::figures {

/// Steps of at most `step_s` up to `until_s`.
struct Phase {
    double until_s = 0, step_s = 0;
};

/// Hangs on the insertion from `from_s` on; a stop keeps the plate from being pulled farther out than it is then.
struct Load {
    double force_n = 0;  ///< W             [0, inf)
    double mass_kg = 0;  ///< m             (0, inf)
    double from_s = 0;   ///< start of a phase, or 0
};

struct MuscleSample {
    double t_s = 0;
    double activation = 0;
    double lengthening_m = 0;  ///< of the distance of the plates, from rest
    double tension_f0 = 0;     ///< mean of what the two plates feel, over F0
    double stretch = 0;        ///< l / l0, mean of the chains
    double speed = 0;          ///< of the fibres over the step, vmax l0; lengthening is positive
    double volume_ratio = 1;   ///< of the belly, to that at rest
};

struct MuscleMotion {
    std::vector<MuscleSample> samples;  ///< the start, which is an equilibrium, and every step
    long steps = 0;
    bool converged = true, diverged = false;
};

struct MotionPlan {
    softbody::MuscleTask task;  ///< its length counts until the load hangs
    std::optional<Load> load;
    std::vector<Phase> phases;
    /// Asked after every step: the motion ends where it is true.
    std::function<bool(const MuscleSample& now)> ended = {};
};

MuscleMotion move_muscle(const softbody::MuscleDescription& muscle, const MotionPlan& plan,
                         const RunOptions& options);

/// "phases": [{"until_s": 0.2, "step_s": 0.01}, ...], each later than the one before.
std::vector<Phase> read_phases(const JsonCursor& json);

}  // namespace risorius::figures
