// A muscle without a body: one fibre and its tendon in a row, the law a solid muscle is held against.
//
//   F0 fT(eps) = F0 [a fl(l/l0) + fp(l/l0)] s/l,   s = L l0 - eps lTs,   l = sqrt(s^2 + w^2)     L  normalised length
#pragma once

#include "body/muscle_body.h"

namespace risorius::experiment {

/// Isometric tension over F0 at a normalised length (muscle_runs.h).
double line_tension(const body::MuscleDescription& muscle, double length, double activation);

/// Fibre length over l0 in that equilibrium.
double line_fibre_length(const body::MuscleDescription& muscle, double length, double activation);

/// Of both tendons together beyond their toes, N/m.
double line_tendon_stiffness(const body::MuscleDescription& muscle);

/// Tension over F0 of fibres of that length that move with a speed over vmax l0, damping included.
double line_moving_tension(const body::MuscleDescription& muscle, double fibre_length, double speed,
                           double activation);

/// At a tension and a fibre length: speed of the fibres over vmax l0, damping included; lengthening is positive.
double line_speed(const body::MuscleDescription& muscle, double tension_f0, double fibre_length,
                  double activation);

/// The same of the insertion: along the tendon pennate fibres count for more.
double line_load_speed(const body::MuscleDescription& muscle, double tension_f0,
                       double fibre_length, double activation);

}  // namespace risorius::experiment
