// SPDX-License-Identifier: MIT
/// \file
/// Scales the muscles of a head so that the standard expressions move its landmarks as they move those of the head on which the
/// standard tables were calibrated.
///
///   minimise  sum over expressions (|u - g| / |g| + length | |u| / |g| - 1 |) + sum keep/2 z^2
///
///   u, g   displacements of the landmarks on this head and on the standard head, at atlas size, m
///   z      logarithms of factors: of the strength of each muscle, of turn and push of each lip, and of the pressure that puffs, |z| <= 1
///   keep   weight of z^2; the push of the lower lip has a larger one
///
/// The method is Gauss-Newton with the face in equilibrium: du/dz = -H^-1 df/dz at the nodes of the skin, where H is the Hessian
/// of the energy and f its gradient. The least squares are reweighted so that the sum consists of lengths, not of squares.
/// Therefore an expression that this head cannot make does not distort the others.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "risorius/core/progress_monitor.h"
#include "risorius/face/face_team.h"
#include "risorius/rig/rig_description.h"
#include "risorius/scene/landmark_displacements.h"

namespace risorius::fitting {

/// The result of fit_strengths().
struct StrengthFit {
    std::map<std::string, double> factor;  ///< muscle -> factor of its previous strength
    rig::LipsDescription lips;
    double difference_before = 0;  ///< mean |u - g| / |g|
    double difference = 0;
};

struct StrengthFitOptions {
    int rounds = 2;
    double keep = 0.03;
    /// Larger, because the lower ring alone could otherwise widen the mouth
    double keep_lower_push = 8;
    double length = 0.5;  ///< weight of an error of length relative to one of direction
};

/// Fits the strengths. The faces are left at rest with the result. Throws Interrupted, and Error when the table names something that
/// the rig does not know.
StrengthFit fit_strengths(face::FaceTeam& team, const rig::RigDescription& rig,
                          const scene::DisplacementTable& standard,
                          const StrengthFitOptions& options, const std::string& place,
                          const ProgressMonitor& monitor);

}  // namespace risorius::fitting
