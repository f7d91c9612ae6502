// SPDX-License-Identifier: MIT
/// \file
/// Finds few action units whose curves reproduce landmarks over time, as an animator would set them.
///
///   minimise over 0 <= w <= 1   1/2 |u(w) - g|^2 / |g_max|^2 + sum_i price_i w_i
///
///   g   displacement of the landmarks in a frame      u(w)   that of the face in equilibrium under the units at intensities w
///
/// The frame of the largest motion decides which units there are (unit_choice.h), by the sum of unit shapes and by expressions that are
/// known of the rig; an equilibrium under the chosen units corrects the sum, and the choice is made again. Then other frames decide that these units do not explain. All frames are fitted with a model (unit_model.h) through equilibria that are simulated in
/// few of them. Keys are left out as long as the face, and not a single curve, stays near (joint_keys.h). Then the script is
/// simulated in some frames; where the model was off, these equilibria correct it, and the values of the keys are fitted again.
#pragma once

#include <string>
#include <vector>

#include "risorius/core/progress_monitor.h"
#include "risorius/inverse/detail/fit_target.h"
#include "risorius/inverse/detail/unit_bench.h"
#include "risorius/track/script.h"

namespace risorius::inverse {

/// Options of solve_units().
struct UnitSolveOptions {
    int most = 8;  ///< maximum number of units in a frame, left and right counting as one
    /// A unit that reduces the squares of what is left by less than those of this RMS, m, is not used; a rare unit and a
    /// muscle have to do more (UnitCandidate::cost).
    double least_gain_m = 4e-5;
    /// RMS that the face may move when both sides share a curve, m
    double same_sides_m = 3e-5;
    double key_error_m = 5e-5;  ///< RMS that the face may move when keys are left out
    int frames = 7;             ///< at most, that are simulated in each round
};

/// The curve of a channel of a script, smooth between keys.
struct UnitCurve {
    std::string channel;  ///< "AU12", "AU12.l", or a muscle
    std::vector<track::Key> keys;
};

struct UnitSolution {
    std::vector<UnitCurve> curves;
    std::vector<track::Drive> drives;  ///< one per frame, of the curves as they are written
    /// Of what is left, one per frame; estimated between the simulated ones
    std::vector<double> rms_m, max_m;
    std::vector<bool> simulated;  ///< one per frame
};

/// `known`: that of the bench. Throws Interrupted.
UnitSolution solve_units(const UnitBench& bench, const FitTarget& given,
                         std::vector<KnownUnits> known, const UnitSolveOptions& options,
                         const ProgressMonitor& monitor);

}  // namespace risorius::inverse
