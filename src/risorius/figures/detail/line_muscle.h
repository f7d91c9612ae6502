// SPDX-License-Identifier: MIT
/// \file
/// The one-dimensional model to which a solid muscle is compared: one fibre and its tendon in series (muscle/equilibrium.h).
///
/// Units: lengths of the whole muscle are normalised (muscle_runs.h), forces are over the maximum isometric force F0, fibre
/// lengths are over the optimal length l0, and speeds are over vmax l0, where vmax is the maximum speed in l0/s.
#pragma once

#include "risorius/softbody/muscle_body.h"

namespace risorius::figures {

/// Returns the isometric tension over F0 at a normalised length.
double line_tension(const softbody::MuscleDescription& muscle, double length, double activation);

/// Returns the same for a muscle with a matrix (tissue between the fibres) of the given volume in parallel with the fibre. The
/// matrix is stretched by s along the fibre and by 1 / sqrt(s) across it. Its energy density is mu/4 |C - 1|^2, where C is the
/// right Cauchy-Green tensor. It pulls with mu [s (s^2 - 1) - (1/s - 1) / s^2], Pa, on the section at rest.
double line_tension_in_matrix(const softbody::MuscleDescription& muscle, double volume_m3,
                              double length, double activation);

/// Returns the fibre length over l0 in the equilibrium of line_tension().
double line_fibre_length(const softbody::MuscleDescription& muscle, double length,
                         double activation);

/// Returns the stiffness of both tendons in series, N/m, where they are stretched beyond the toe region, the soft start of their
/// curve.
double line_tendon_stiffness(const softbody::MuscleDescription& muscle);

/// Returns the tension over F0 of fibres of the given length at the given speed, damping included.
double line_moving_tension(const softbody::MuscleDescription& muscle, double fibre_length,
                           double speed, double activation);

/// Returns the speed of fibres of the given length at the given tension, damping included; lengthening is positive.
double line_speed(const softbody::MuscleDescription& muscle, double tension_f0, double fibre_length,
                  double activation);

/// Returns the speed of the insertion in the same state. It differs from that of the fibres if these are pennate.
double line_load_speed(const softbody::MuscleDescription& muscle, double tension_f0,
                       double fibre_length, double activation);

}  // namespace risorius::figures
