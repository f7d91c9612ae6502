// SPDX-License-Identifier: MIT
/// \file
/// The painted skin on texture coordinates, for programs that do not know the paint map.
#pragma once

#include <cstdint>
#include <vector>

#include "risorius/core/image.h"
#include "risorius/render/scene.h"

namespace risorius::render {

/// `map`: side x side x 4 bytes of paint_skin(), rows from the bottom. `square`: the picture to draw on, alpha 0 where it is
/// empty; the skin is drawn over it. Uncovered texels get the colour of the nearest covered one within a few pixels, or else the
/// skin tone of the scene.
Image unfold_paint(const Scene& scene, const Vec3& centre, const std::vector<std::uint8_t>& map,
                   int map_side, Image square);

}  // namespace risorius::render
