// SPDX-License-Identifier: MIT
/// \file
/// Kind "hanging-curve": the equilibrium of a curve that is held at its two ends, at several resolutions, compared with the
/// catenary.
///
///   "body": {"kind": "curve", ...}, "grids": [[11], [21], [41]], "integrator": {...}, "duration_s": 20
///
/// The catenary is that of an inextensible curve without bending stiffness, z = a cosh((x - x0) / a) + const (Huygens, Leibniz
/// and Johann Bernoulli 1691), through the ends and with the rest length. Measures: sag_m/<grid>, sag_error_percent/<grid>,
/// distance_ratio/<grid> (maximum distance of a node from its point on the catenary, over the length), stretch_percent/<grid>,
/// force_ratio/<grid> (residual force), and order/<grid>: the order of convergence, the power of the spacing by which the
/// distance fell since the previous grid.
#pragma once

#include "risorius/figures/detail/experiment_kind.h"

namespace risorius::figures {

void run_hanging_curve(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome);

/// Points of the catenary of the given length between two points, evenly spaced along it, z up. The length must be larger than
/// the distance of the points, which must not be vertical.
Points catenary(const Vec3& from, const Vec3& to, double length_m, int points);

}  // namespace risorius::figures
