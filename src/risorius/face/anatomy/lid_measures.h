// SPDX-License-Identifier: MIT
/// \file
/// Measures of the eyelids in a pose: the opening they leave, and how far they reach into the eye.
#pragma once

#include <array>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/lids.h"
#include "risorius/rig/head.h"

namespace risorius::face {

/// Height of the largest opening between the lids through which the eye's centre is visible, m, over the whole fissure and beyond.
double max_lid_gap_m(const rig::Head& head, const EyeLids& lids, const Points& vertices);

/// How much deeper than at rest the skin around the eyes reaches into the eyes' surfaces, m; 0 where it does not. `turn`: rotation of each eye.
double depth_in_eyes_m(const rig::Head& head, const std::array<Mat3, 2>& turn,
                       const Points& vertices);

}  // namespace risorius::face
