// SPDX-License-Identifier: MIT
/// \file
/// Kind "hanging-curve": the equilibrium of a curve that is held at its two ends, at several resolutions, compared with the
/// catenary.
///
///   "body": {"kind": "curve", ...}, "grids": [[11], [21], [41]], "integrator": {...}, "duration_s": 20
///
/// The catenary is that of an inextensible curve without bending stiffness, z = a cosh((x - x0) / a) + const (Huygens, Leibniz
/// and Johann Bernoulli 1691), which goes through the two ends and has the rest length. Measures: sag_m/<grid> (sag of the
/// curve), sag_error_percent/<grid> (its difference from the sag of the catenary), distance_ratio/<grid> (maximum distance of a
/// node from its point on the catenary, over the length), stretch_percent/<grid>, force_ratio/<grid> (residual force, see
/// settle.h), and order/<grid>, the order of convergence: the power p for which the distance fell as (node spacing)^p from the
/// previous grid to this one.
#pragma once

#include "risorius/figures/detail/experiment_kind.h"

namespace risorius::figures {

void run_hanging_curve(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome);

/// Returns `points` points of the catenary of the given length between two points, evenly spaced along it, with z up. The length
/// must be larger than the distance of the two points, and neither of them may lie straight above the other.
Points catenary(const Vec3& from, const Vec3& to, double length_m, int points);

}  // namespace risorius::figures
