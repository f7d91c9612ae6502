// SPDX-License-Identifier: MIT
/// \file
/// Boundary conditions of the tissue: the state of bones, lids, eyes, air and gravity, which act on the tissue.
#pragma once

#include <array>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/lids.h"
#include "risorius/solve/node_blend.h"

namespace risorius::face {

/// A spring from a point of the tissue to a hand, with a damper. It pulls with at most strongest_n.
struct PullSpring {
    solve::NodeBlend at;
    Vec3 tied_to = Vec3::Zero();  ///< m
    double stiffness_n_per_m = 0, damping_ns_per_m = 0, strongest_n = 0;
};

/// The boundary conditions at one moment.
struct BoundaryState {
    Rigid mandible = Rigid::Identity();  ///< motion of the mandible from rest, head frame
    std::array<LidPose, 2> lid;          ///< left and right
    double mouth_pressure_pa = 0;        ///< > 0 puffs the cheeks
    std::array<Mat3, 2> gaze{Mat3::Identity(), Mat3::Identity()};  ///< rotation of each eye
    /// Gravity in the head frame minus that of the rest shape, m/s^2.
    Vec3 weight_m_s2 = Vec3::Zero();
    std::vector<PullSpring> pulls{};  ///< springs by which hands hold the skin, head frame
};

}  // namespace risorius::face
