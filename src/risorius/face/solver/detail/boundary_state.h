// SPDX-License-Identifier: MIT
/// \file
/// Boundary conditions of the tissue: what moves by itself and takes the tissue along.
#pragma once

#include <array>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/lids.h"

namespace risorius::face {

struct BoundaryState {
    Rigid mandible = Rigid::Identity();  ///< motion of the mandible from rest, head frame
    std::array<LidPose, 2> lid;
    double mouth_pressure_pa = 0;
    std::array<Mat3, 2> gaze{Mat3::Identity(), Mat3::Identity()};  ///< rotation of each eye
    Vec3 weight_m_s2 = Vec3::Zero();  ///< acceleration of all tissue beyond that of the rest shape
};

}  // namespace risorius::face
