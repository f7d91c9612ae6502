// SPDX-License-Identifier: MIT
/// \file
/// A muscle simulated with implicit Euler steps and the forces on its plates. The plates are held at prescribed lengths, or the
/// muscle pulls a weight.
///
///   m x'' = T - W      x   displacement of the load, m      T   tension, N       W   weight of the load, N       m   its mass
///
/// Load and muscle are stepped in turn. The speed of the load moves the plate during the muscle's step, and the tension at the
/// end of that step accelerates the load. This is the symplectic Euler method. It is stable while the time step is below 2 sqrt(m
/// / k), where k is the stiffness of the tendons.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "risorius/figures/detail/run_options.h"
#include "risorius/softbody/muscle_body.h"

namespace risorius::figures {

/// A part of the motion up to `until_s` with steps of at most `step_s`.
struct Phase {
    double until_s = 0, step_s = 0;
};

/// A weight that hangs on the insertion from the time `from_s` on. A stop prevents the plate from moving farther out than it was
/// at that time.
struct Load {
    double force_n = 0;  ///< W             [0, inf)
    double mass_kg = 0;  ///< m             (0, inf)
    double from_s = 0;   ///< start of a phase, or 0
};

/// The state of a muscle at one time.
struct MuscleSample {
    double t_s = 0;
    double activation = 0;
    double lengthening_m = 0;  ///< change of the distance of the plates from rest
    double tension_f0 = 0;     ///< mean tension at the two plates, over F0
    double stretch = 0;        ///< l / l0, mean over the chains of fibres
    /// Mean speed of the fibres over the step, over vmax l0; lengthening is positive
    double speed = 0;
    double volume_ratio = 1;  ///< volume of the belly over that at rest
};

struct MuscleMotion {
    /// At the start, which is an equilibrium, and after every step
    std::vector<MuscleSample> samples;
    long steps = 0;
    bool converged = true, diverged = false;
};

/// What is done to a muscle, and for how long.
struct MotionPlan {
    /// Activation and length over time; the length applies until the load hangs on the muscle
    softbody::MuscleTask task;
    std::optional<Load> load;
    std::vector<Phase> phases;
    /// Checked after every step; the motion ends when it is true.
    std::function<bool(const MuscleSample& now)> ended = {};
};

MuscleMotion move_muscle(const softbody::MuscleDescription& muscle, const MotionPlan& plan,
                         const RunOptions& options);

/// Reads "phases": [{"until_s": 0.2, "step_s": 0.01}, ...], in ascending order of time.
std::vector<Phase> read_phases(const JsonCursor& json);

}  // namespace risorius::figures
