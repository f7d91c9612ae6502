// SPDX-License-Identifier: MIT
/// \file
/// Finds few action units whose curves reproduce landmarks over time, as an animator would set them.
///
///   minimise over w_t >= 0   |U w_t + d_t - g_t|_w^2 + ridge     for each frame t
///
///   g   displacement of the landmarks      U   displacement of each unit, one column each      d   what U w lacks of the simulation
///
/// First, U is linear at rest, and the units are chosen one after the other: always the one, left and right together, that explains
/// most of what is left in all frames. Single muscles are tried when no unit explains enough of it. Then the columns of the
/// chosen ones are simulated at their largest weights, and d_t is simulated in a few frames and interpolated between them. Then
/// further units are chosen for what is left, and so on.
/// Source of the choice: orthogonal matching pursuit, Pati, Rezaiifar & Krishnaprasad 1993, Asilomar, 40-44, with weights >= 0.
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
    int most = 8;               ///< maximum number of units, left and right counting as one
    double enough_m = 5e-5;     ///< the choice ends when the RMS of what is left is smaller
    double least_gain = 0.005;  ///< fraction of |g|^2 that a further unit must explain
    double same_sides = 0.03;   ///< sides whose weights differ by less share a curve
    double key_tolerance = 0.01;
    int simulated_frames = 6;
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
    std::vector<track::Drive> drives;  ///< one per frame, of the weights before keys were reduced
    std::vector<double> rms_m,
        max_m;  ///< of what is left, one per frame; estimated between the simulated ones
    std::vector<bool> simulated;  ///< one per frame
};

/// `face` is left in some pose. Throws Interrupted.
UnitSolution solve_units(face::Face& face, const scene::RigFiles& files, const FitTarget& given,
                         const UnitSolveOptions& options, const ProgressMonitor& monitor);

}  // namespace risorius::inverse
