// SPDX-License-Identifier: MIT
/// \file
/// The certificate of a blend shape: physical measures of its quality. They are change of volume, penetration, the gap of closed
/// eyes and symmetry, measured on the simulated pose and on the displaced mesh.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "risorius/blendshapes/detail/shape_measures.h"
#include "risorius/core/json_cursor.h"

namespace risorius::blendshapes {

/// The largest accepted values of a certificate.
struct ShapeLimits {
    double volume_ratio = 0.02;  ///< magnitude of ShapeCertificate::volume_change
    /// Penetration of one lip into the other, and of skin into an eye
    double penetration_m = 0.3e-3;
    double lid_gap_m = 0.3e-3;    ///< gap that a blink leaves
    double asymmetry_m = 0.2e-3;  ///< on a symmetric head
    double rigid_part_m = 0.1e-3;
};

/// Measured values of one shape.
struct ShapeCertificate {
    double volume_change = 0;  ///< volume of all tissue over that at rest, minus 1
    /// Largest penetration of one lip into the other, beyond that at rest
    double lip_depth_m = 0;
    /// Penetration of tissue into bone and teeth. It has no limit, because the surfaces of bone are estimates
    double bone_depth_m = 0;
    double eye_depth_m = 0;           ///< penetration of skin into the eyes
    double rigid_part_m = 0;          ///< how far teeth and eyes are bent (rigid_parts.h)
    std::optional<double> lid_gap_m;  ///< only for shapes that close the eye
    std::optional<double> lip_gap_m;  ///< only for shapes that close the mouth over an open jaw
    /// Of the shape, or between it and its namesake on the other side
    std::optional<double> asymmetry_m;
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
