// SPDX-License-Identifier: MIT
/// \file
/// Transfers the paint map (skin_paint.h) to the texture coordinates of the mesh, for other programs, which do not know the map.
#pragma once

#include <cstdint>
#include <vector>

#include "risorius/core/image.h"
#include "risorius/render/scene.h"

namespace risorius::render {

/// `map`: the texture of paint_skin(), map_side x map_side x 4 bytes, rows from the bottom. `square`: the picture to draw on,
/// alpha 0 where it is empty; the skin is drawn over it. Uncovered texels get the colour of the nearest covered one within a few
/// pixels, or else the skin tone of the scene.
Image unfold_paint(const Scene& scene, const Vec3& centre, const std::vector<std::uint8_t>& map,
                   int map_side, Image square);

}  // namespace risorius::render
