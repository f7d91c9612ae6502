// SPDX-License-Identifier: MIT
/// \file
/// Finds few action units whose curves reproduce landmarks over time, as an animator would set them.
///
///   minimise over 0 <= w <= 1   1/2 |u(w) - g|_w^2 / |g_max|_w^2 + sum_i price_i w_i
///
///   g   displacement of the landmarks in a frame      u(w)   that of the face in equilibrium under the units at intensities w
///
/// The frame of the largest motion decides which units there are: all are sought at a price, by Gauss-Newton steps between equilibria, and
/// those that matter most are kept. Muscles alone are tried for what is left, at a higher price. Then the kept ones are
/// fitted in a few frames, from weights in proportion, and in the frames between by a model that is linear around both neighbours.
/// Weights are intensities: the curve from the intensity to the activation is part of u, so that a script plays what was found.
#pragma once

#include <string>
#include <vector>

#include "risorius/core/progress_monitor.h"
#include "risorius/face/face.h"
#include "risorius/inverse/detail/fit_target.h"
#include "risorius/scene/rig_files.h"
#include "risorius/track/script.h"

namespace risorius::inverse {

/// Options of solve_units().
struct UnitSolveOptions {
    int most = 8;              ///< maximum number of units, left and right counting as one
    double enough_m = 5e-5;    ///< the choice ends when the RMS of what is left is smaller
    double least_gain = 2e-5;  ///< share of |g_max|^2 that a unit must move
    double same_sides = 0.03;  ///< sides whose weights differ by less share a curve
    double key_tolerance = 0.01;
    double key_error_m =
        3e-5;  ///< RMS; keys of units that move little may be farther off, up to three tolerances
    int simulated_frames = 9;
    /// Units of the pressure in the mouth and of the tongue are candidates too.
    bool pressure = false, tongue = false;
    face::StaticOptions rest = {};
};

/// The curve of a channel of a script.
struct UnitCurve {
    std::string channel;  ///< "AU12", "AU12.l", or a muscle
    std::vector<track::Key> keys;
};

struct UnitSolution {
    std::vector<UnitCurve> curves;
    std::vector<track::Drive> drives;  ///< one per frame, of the curves as they are written
    std::vector<double> rms_m,
        max_m;  ///< of what is left, one per frame; estimated between the simulated ones
    std::vector<bool> simulated;  ///< one per frame
};

/// `face` is left in some pose. Throws Interrupted.
UnitSolution solve_units(face::Face& face, const scene::RigFiles& files, const FitTarget& given,
                         const UnitSolveOptions& options, const ProgressMonitor& monitor);

}  // namespace risorius::inverse
