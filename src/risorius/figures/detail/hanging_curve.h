// SPDX-License-Identifier: MIT
/// \file
/// Kind "hanging-curve": a curve held at its two ends comes to rest, at several resolutions, against the catenary.
///
///   "body": {"kind": "curve", ...}, "grids": [[11], [21], [41]], "integrator": {...}, "duration_s": 20
///
/// The catenary is that of an inextensible curve without bending, z = a cosh((x - x0) / a) + const (Huygens, Leibniz and
/// Johann Bernoulli 1691), through the ends and of the length at rest. Measured: sag_m/<grid>, sag_error_percent/<grid>,
/// distance_ratio/<grid> (the greatest distance of a node from its own place on the catenary, over the length),
/// stretch_percent/<grid>, force_ratio/<grid> (what is left out of balance), and order/<grid>: the power of the spacing with
/// which the distance has fallen since the grid before.
#pragma once

#include "risorius/figures/detail/experiment_kind.h"

namespace risorius::figures {

void run_hanging_curve(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome);

/// Points of the catenary of that length between two points, evenly spaced along it, z up. The length is greater than
/// their distance, which is not vertical.
Points catenary(const Vec3& from, const Vec3& to, double length_m, int points);

}  // namespace risorius::figures
