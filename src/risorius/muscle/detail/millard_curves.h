// SPDX-License-Identifier: MIT
/// \file
/// The force-length, force-velocity and tendon curves of Millard's muscle, dimensionless, with the symbols of muscle_curves.h.
/// Bezier curves of fifth order connect points of given slope. The curves are C2, except where they become straight; there they
/// are C1. So they need no smoothing.
///
/// The values are those of OpenSim's Millard2012EquilibriumMuscle with a damped fibre, whose active curve falls to 0.
/// `curviness` is OpenSim's measure of how round a corner is, 0 to 1.
///
/// Source: M. Millard, T. Uchida, A. Seth, S. L. Delp 2013, Flexing computational muscle, J. Biomech. Eng. 135(2), 021005.
#pragma once

#include "risorius/muscle/muscle_curves.h"

namespace risorius::muscle {

/// The numbers of Millard's curves. The field names are the keys of "curves" in a file.
struct MillardShape {
    /// Minimum l with active force                            (0, inf)
    double active_shortest = 0.4441;
    /// l at which the steep ascent becomes shallow   (active_shortest, 0.95)
    double active_transition = 0.73;
    double active_longest = 1.8123;  ///< maximum l with active force   (1.1, inf)
    /// Slope of the shallow ascent   (0, (1 - active_minimum) / (1 - active_transition))
    double active_shallow_slope = 0.8616;
    double active_minimum = 0;    ///< active f outside these lengths                       [0, 1)
    double passive_strain = 0.7;  ///< strain at which passive f is 1                   (0, inf)
    double passive_low_stiffness = 0.2;  ///< slope at the start   (0, 1 / passive_strain)
    double passive_steepness = 2;     ///< slope at f = 1, times passive_strain             (1, inf)
    double passive_curviness = 0.75;  ///<                                                  [0, 1]
    double shortening_end_slope = 0.25;  ///< slope of f near v = -1                         (0, 1]
    double isometric_slope = 5;  ///< slope of f at v = 0                              (1, inf)
    double lengthening_end_slope = 0.15;  ///< slope of f near v = 1   (0, lengthening_force - 1)
    double lengthening_force = 1.4;  ///< f from v = 1 on                                  (1, inf)
    double shortening_curviness = 0.6;  ///<                                                  [0, 1]
    double lengthening_curviness = 0.9;  ///<                                                 [0, 1]
    double tendon_strain = 0.049;     ///< eps at which fT is 1                             (0, inf)
    double tendon_steepness = 1.375;  ///< slope there, times tendon_strain                (1, inf)
    double tendon_toe_force = 2. / 3;  ///< f at the end of the toe                        (0, 1)
    double tendon_curviness = 0.5;     ///<                                                  [0, 1]
};

/// Returns the curves. Throws std::invalid_argument when numbers are outside their ranges or contradict each other.
MuscleCurves millard_curves(const MillardShape& shape = {});

}  // namespace risorius::muscle
