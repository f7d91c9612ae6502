// SPDX-License-Identifier: MIT
/// \file
/// Measures of the eyelids in a pose: the opening they leave, and how far they reach into the eye.
#pragma once

#include <array>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/lids.h"
#include "risorius/rig/head.h"

namespace risorius::face {

/// Returns the maximum height of the opening between the lids, m, over the whole fissure and a little beyond. The opening is measured
/// as seen from the centre of the eye. `vertices`: V x 3, m, head frame.
double max_lid_gap_m(const rig::Head& head, const EyeLids& lids, const Points& vertices);

/// Returns how much deeper than at rest the skin around the eyes reaches into the eyes, m; 0 if it does not. `turn`: rotation of each
/// eye from rest; `vertices`: V x 3, m, head frame.
double depth_in_eyes_m(const rig::Head& head, const std::array<Mat3, 2>& turn,
                       const Points& vertices);

}  // namespace risorius::face
