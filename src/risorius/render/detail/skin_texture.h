// SPDX-License-Identifier: MIT
/// \file
/// The painted skin on texture coordinates, for programs that do not know its map.
#pragma once

#include <cstdint>
#include <vector>

#include "risorius/core/image.h"
#include "risorius/render/scene.h"

namespace risorius::render {

/// `map`: side x side x 4 bytes of paint_skin(), rows from below. `square`: what else lies on it, alpha 0 where nothing does; the skin
/// goes over it. What nothing covers then has the colour of the nearest place within some pixels of it, or the scene's tone.
Image unfold_paint(const Scene& scene, const Vec3& centre, const std::vector<std::uint8_t>& map,
                   int map_side, Image square);

}  // namespace risorius::render
