// SPDX-License-Identifier: MIT
/// \file
/// Scales the muscles of a head so that the standard expressions move its landmarks as they move those of the head that the
/// standard tables were calibrated on.
///
///   minimise  sum over expressions (|u - g| / |g| + length | |u| / |g| - 1 |) + sum keep/2 z^2
///
///   u, g   displacements of the landmarks on this head and on the standard head, at atlas size, m
///   z      logarithms of factors on the strength of each muscle, on turn and push of each lip, and on the pressure that puffs, |z| <= 1
///   keep   weight of a change; the push of the lower lip has its own
///
/// Gauss-Newton over faces in equilibrium, du/dz = -H^-1 dg/dz at the nodes of the skin. Squares are reweighted so that the sum is one of
/// lengths: an expression that this head cannot make does not distort the others.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "risorius/core/progress_monitor.h"
#include "risorius/face/face.h"
#include "risorius/rig/rig_description.h"
#include "risorius/scene/landmark_displacements.h"

namespace risorius::fitting {

struct StrengthFit {
    std::map<std::string, double> factor;  ///< muscle -> factor on its previous strength
    rig::LipsDescription lips;
    double difference_before = 0;  ///< mean |u - g| / |g|
    double difference = 0;
};

struct StrengthFitOptions {
    int rounds = 2;
    double keep = 0.03;
    double keep_lower_push = 8;  ///< freer, the lower ring alone may widen the mouth
    double length = 0.5;         ///< weight of an error in length relative to one in direction
};

/// `face` is left at rest with the result. Throws Interrupted; Error when the table names something that the rig does not know.
StrengthFit fit_strengths(face::Face& face, const rig::RigDescription& rig,
                          const scene::DisplacementTable& standard,
                          const StrengthFitOptions& options, const std::string& place,
                          const ProgressMonitor& monitor);

}  // namespace risorius::fitting
