// SPDX-License-Identifier: MIT
/// \file
/// Physical quality measures of a blend shape, taken on its simulated pose and on the displaced mesh: change of volume,
/// penetration, gap of closed eyes, symmetry.
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
    double penetration_m = 0.3e-3;  ///< of lip in lip, and of skin in the eye
    double lid_gap_m = 0.3e-3;      ///< gap that a blink leaves
    double asymmetry_m = 0.2e-3;    ///< on a symmetric head
};

/// Measured values of one shape.
struct ShapeCertificate {
    double volume_change = 0;  ///< of all tissue, ratio
    double lip_depth_m = 0;    ///< largest penetration of lip in lip beyond that at rest
    /// Penetration of tissue into bone and teeth, whose surfaces are estimates
    double bone_depth_m = 0;
    double eye_depth_m = 0;             ///< penetration of skin into the eyes
    std::optional<double> lid_gap_m;    ///< only for shapes that close the eye
    std::optional<double> lip_gap_m;    ///< only for shapes that close the mouth over an open jaw
    std::optional<double> asymmetry_m;  ///< of a shape, or of it and its namesake on the other side
    /// The asymmetry before mirroring. It is large when the lips have buckled to one side.
    std::optional<double> asymmetry_as_solved_m;
    blendshapes::Stretch stretch;  ///< of the simulated skin
    double peak_m = 0;             ///< largest displacement
    int moved_vertices = 0;
    bool converged = true;
    int inverted_tets = 0;

    /// Descriptions of the values beyond their limits; empty when there are none.
    std::vector<std::string> complaints(const ShapeLimits& limits = {}) const;
    Json json() const;  ///< lengths in mm
};

}  // namespace risorius::blendshapes
