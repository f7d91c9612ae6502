// SPDX-License-Identifier: MIT
/// \file
/// Positions on a ribbon of eyelashes. The shader cuts single hairs out of the ribbon by these positions, without texture or
/// alpha.
#pragma once

#include <vector>

#include "risorius/render/scene.h"

namespace risorius::render {

struct LashPlace {
    bool is_lash = false;
    bool lower_lid = false;
    float along_m = 0.0F;   ///< position of the root along the lid
    float fraction = 0.0F;  ///< from root (0) to tip (1)
};

/// One LashPlace per vertex of the scene. The roots are the edge of the ribbon nearest to the centre of the eye.
std::vector<LashPlace> lash_places(const Scene& scene);

}  // namespace risorius::render
