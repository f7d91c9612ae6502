// SPDX-License-Identifier: MIT
/// \file
/// The reference law for a solid muscle: one fibre and its tendon in series (muscle/equilibrium.h), in the units of the figures:
/// normalised lengths (muscle_runs.h), forces over F0, speeds over vmax l0.
#pragma once

#include "risorius/softbody/muscle_body.h"

namespace risorius::figures {

/// Isometric tension over F0 at a normalised length (muscle_runs.h).
double line_tension(const softbody::MuscleDescription& muscle, double length, double activation);

/// The same with a matrix of cells of the given volume in parallel with the fibre. The matrix is stretched by s along the fibre
/// and by 1 / sqrt(s) across; its energy mu/4 |C - 1|^2 pulls with mu [s (s^2 - 1) - (1/s - 1) / s^2] per area of the rest
/// section.
double line_tension_in_matrix(const softbody::MuscleDescription& muscle, double volume_m3,
                              double length, double activation);

/// Fibre length over l0 in the equilibrium of line_tension().
double line_fibre_length(const softbody::MuscleDescription& muscle, double length,
                         double activation);

/// Stiffness of both tendons in series, beyond their toe regions, N/m.
double line_tendon_stiffness(const softbody::MuscleDescription& muscle);

/// Tension over F0 of fibres of the given length at a speed over vmax l0, damping included.
double line_moving_tension(const softbody::MuscleDescription& muscle, double fibre_length,
                           double speed, double activation);

/// Speed of the fibres over vmax l0 at a tension and a fibre length, damping included; lengthening is positive.
double line_speed(const softbody::MuscleDescription& muscle, double tension_f0, double fibre_length,
                  double activation);

/// The same for the speed of the insertion, which is larger than that of pennate fibres.
double line_load_speed(const softbody::MuscleDescription& muscle, double tension_f0,
                       double fibre_length, double activation);

}  // namespace risorius::figures
