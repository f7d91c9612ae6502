// SPDX-License-Identifier: MIT
/// \file
/// The law a solid muscle is held against: one fibre and its tendon in a row (muscle/equilibrium.h), in the units of the
/// figures: normalised lengths (muscle_runs.h), forces over F0, speeds over vmax l0.
#pragma once

#include "risorius/softbody/muscle_body.h"

namespace risorius::figures {

/// Isometric tension over F0 at a normalised length (muscle_runs.h).
double line_tension(const softbody::MuscleDescription& muscle, double length, double activation);

/// The same with a matrix of cells of that volume beside the fibre: stretched by s along, by 1 / sqrt(s) across,
/// mu/4 |C - 1|^2 pulls with mu [s (s^2 - 1) - (1/s - 1) / s^2] of the section at rest.
double line_tension_in_matrix(const softbody::MuscleDescription& muscle, double volume_m3,
                              double length, double activation);

/// Fibre length over l0 in that equilibrium.
double line_fibre_length(const softbody::MuscleDescription& muscle, double length,
                         double activation);

/// Of both tendons together beyond their toes, N/m.
double line_tendon_stiffness(const softbody::MuscleDescription& muscle);

/// Tension over F0 of fibres of that length that move with a speed over vmax l0, damping included.
double line_moving_tension(const softbody::MuscleDescription& muscle, double fibre_length,
                           double speed, double activation);

/// At a tension and a fibre length: speed of the fibres over vmax l0, damping included; lengthening is positive.
double line_speed(const softbody::MuscleDescription& muscle, double tension_f0, double fibre_length,
                  double activation);

/// The same of the insertion: along the tendon pennate fibres count for more.
double line_load_speed(const softbody::MuscleDescription& muscle, double tension_f0,
                       double fibre_length, double activation);

}  // namespace risorius::figures
