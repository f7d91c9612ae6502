// What can be seen of a pose's eyelids: whether they leave the eye open, and whether they reach into it.
#pragma once

#include <array>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/lids.h"
#include "risorius/rig/head.h"

namespace risorius::face {

/// The largest stretch, m, along which the eye's centre looks out between the lids, over the whole fissure and beyond.
double largest_lid_gap_m(const rig::Head& head, const EyeLids& lids, const Points& vertices);

/// How much deeper than at rest the skin around the eyes reaches into their surfaces, m; 0 when nowhere. `turn`: of each eye.
double depth_in_eyes_m(const rig::Head& head, const std::array<Mat3, 2>& turn,
                       const Points& vertices);

}  // namespace risorius::face
