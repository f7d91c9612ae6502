// Coordinates on a ribbon of eyelashes, so that single hairs can be cut out of it without texture or alpha.
#pragma once

#include <vector>

#include "render/scene.h"

namespace risorius::render {

/// Two floats per vertex of the scene: length along the lid in m, and share of the way from root to tip. Zero for what is no
/// lash. Roots are where the ribbon meets the skin.
std::vector<float> lash_coordinates(const Scene& scene);

}  // namespace risorius::render
