// SPDX-License-Identifier: MIT
/// \file
/// The four force curves of a musculotendon after Zajac: the active and passive force-length curves, the force-velocity curve
/// and the tendon curve. They are dimensionless and C1.
///
///   l     fibre length / optimal fibre length                  active fl(l): peak 1 at l = 1; passive fp(l)
///   v     fibre speed / maximum shortening speed, v < 0 shortens   velocity fv(v): 1 at v = 0
///   eps   tendon strain (lT - lTs) / lTs                        tendon fT(eps)
///   f     force / maximum isometric force
///
/// lT is the tendon length, and lTs is its slack length. Each published set is a function that returns MuscleCurves. The
/// sources of this one are F. E. Zajac, Crit. Rev. Biomed. Eng. 17(4), 1989, and S. L. Delp, Stanford 1990, with the tables
/// that musculoskeletal simulators use. They are normalised so that the peak of the active curve is exactly (1, 1). The kinks
/// of the published passive curve, tendon curve and lengthening branch are smoothed.
#pragma once

#include <utility>
#include <vector>

#include "risorius/muscle/detail/curve.h"

namespace risorius::muscle {

/// The four force curves of a muscle and its tendon: fl, fp, fv and fT.
struct MuscleCurves {
    Curve active, passive, velocity, tendon;
};

/// The numbers of Zajac's curves. The field names are the keys of "curves" in a file.
struct ZajacShape {
    /// Points (l, f) of the active curve. The slopes at the points are those of a Catmull-Rom curve, except that they are zero
    /// at both ends and at the peak. Otherwise the curve would be higher than 1 beside the peak.
    std::vector<std::pair<double, double>> active_points = {
        {0.401, 0.0},   {0.527, 0.227}, {0.629, 0.637}, {0.719, 0.857}, {0.861, 0.950},
        {1.000, 1.000}, {1.218, 0.770}, {1.439, 0.247}, {1.619, 0.0}};
    double passive_strain = 0.47;      ///< e0, strain at which passive f is 1      (0, inf)
    double passive_exponent = 4;       ///< k                                       (0, inf)
    double hill_curvature = 0.25;      ///< a / F0 of Hill's hyperbola              (0, inf)
    double lengthening_force = 1.4;    ///< limit of f for large v > 0                      (1, inf)
    double tendon_strain = 0.033;      ///< eps at which fT is 1                    (0, inf)
    double tendon_toe_force = 1. / 3;  ///< f at the end of the toe                 (0, 1)
    double tendon_toe_exponent = 3;    ///< kt                                      (0, inf)
};

/// Returns the curves. Throws std::invalid_argument when a number is outside its range, when l does not increase from point to
/// point, or when the active curve has no peak.
MuscleCurves zajac_curves(const ZajacShape& shape = {});

}  // namespace risorius::muscle
