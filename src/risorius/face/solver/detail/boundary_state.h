// SPDX-License-Identifier: MIT
/// \file
/// Boundary conditions of the tissue: the state of bones, lids, eyes, air and gravity, which act on the tissue.
#pragma once

#include <array>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/lids.h"

namespace risorius::face {

/// The boundary conditions at one moment.
struct BoundaryState {
    Rigid mandible = Rigid::Identity();  ///< motion of the mandible from rest, head frame
    std::array<LidPose, 2> lid;          ///< left and right
    double mouth_pressure_pa = 0;        ///< > 0 puffs the cheeks
    std::array<Mat3, 2> gaze{Mat3::Identity(), Mat3::Identity()};  ///< rotation of each eye
    /// Gravity in the head frame minus that of the rest shape, m/s^2.
    Vec3 weight_m_s2 = Vec3::Zero();
};

}  // namespace risorius::face
