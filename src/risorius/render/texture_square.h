// SPDX-License-Identifier: MIT
/// \file
/// Helpers for making a square picture on texture coordinates. Alpha is 0 where the picture is still empty.
#pragma once

#include <vector>

#include "risorius/core/image.h"
#include "risorius/core/types.h"
#include "risorius/render/scene.h"

namespace risorius::render {

std::uint8_t srgb_byte(double linear);

/// What a texel shows: a point of a triangle of the skin.
struct SkinTexel {
    int surface = -1;  ///< index in Scene::surfaces; -1: nothing
    int triangle = 0;
    Vec3 share = Vec3::Zero();  ///< of the three corners; they sum to 1
};
/// Returns the texels of a square picture, rows from the top. Where triangles overlap on the texture coordinates, as the insides and
/// outsides of lids may, those that look away from `centre` win, and among them the farthest.
std::vector<SkinTexel> skin_texels(const Scene& scene, const Vec3& centre, int side_px);

/// Extends the colours a few texels beyond the border of the covered area, so that filtering shows no seam. Texels farther away
/// get the colour `otherwise`, sRGB 0..1.
void fill_uncovered(Image& image, const Vec3& otherwise);

/// Returns the mean of the covered texels, sRGB 0..1; black if there are none.
Vec3 mean_colour(const Image& image);

}  // namespace risorius::render
