// SPDX-License-Identifier: MIT
/// \file
/// Places on a ribbon of eyelashes, so that single hairs can be cut out of it without texture or alpha.
#pragma once

#include <vector>

#include "risorius/render/scene.h"

namespace risorius::render {

struct LashPlace {
    bool is_lash = false;
    bool lower_lid = false;
    float along_m = 0.0F;   ///< of its root, along the lid
    float fraction = 0.0F;  ///< of the way from root to tip
};

/// One per vertex of the scene. Roots are the edge of the ribbon nearest to the middle of the eye.
std::vector<LashPlace> lash_places(const Scene& scene);

}  // namespace risorius::render
