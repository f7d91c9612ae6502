// SPDX-License-Identifier: MIT
/// \file
/// Measures of the physical quality of a blend shape, on its simulated pose and on the displaced mesh: change of volume, penetration, gaps
/// of closed eyes, symmetry.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "risorius/blendshapes/detail/shape_measures.h"
#include "risorius/core/json_cursor.h"

namespace risorius::blendshapes {

/// Limits of a certificate.
struct ShapeLimits {
    double volume_ratio = 0.02;     ///< change of the tissue's volume
    double penetration_m = 0.3e-3;  ///< lip in lip, skin in eye
    double lid_gap_m = 0.3e-3;      ///< gap that a blink leaves
    double asymmetry_m = 0.2e-3;    ///< on a head that is its own mirror image
};

struct ShapeCertificate {
    double volume_change = 0;  ///< ratio, of all tissue
    double lip_depth_m = 0;    ///< largest penetration of lip in lip beyond that at rest
    double bone_depth_m =
        0;  ///< penetration of tissue in bone and teeth, whose surfaces are estimated
    double eye_depth_m = 0;             ///< of skin in the eyes
    std::optional<double> lid_gap_m;    ///< only for shapes that close the eye
    std::optional<double> lip_gap_m;    ///< only for shapes that close the mouth over an open jaw
    std::optional<double> asymmetry_m;  ///< of a shape, or of it and its namesake
    /// The asymmetry before both sides were made mirror images: large where lips have buckled to one side.
    std::optional<double> asymmetry_as_solved_m;
    blendshapes::Stretch stretch;  ///< of the simulated skin
    double peak_m = 0;             ///< largest displacement
    int moved_vertices = 0;
    bool converged = true;
    int inverted_tets = 0;

    /// The values beyond their limits in words; empty when there are none.
    std::vector<std::string> complaints(const ShapeLimits& limits = {}) const;
    Json json() const;  ///< lengths in mm
};

}  // namespace risorius::blendshapes
