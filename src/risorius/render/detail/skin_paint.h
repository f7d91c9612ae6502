// SPDX-License-Identifier: MIT
/// \file
/// Skin generated for any head: a map painted once from the landmarks and sampled in every frame.
///
/// The map is Lambert's equal-area azimuthal projection of directions from the middle of the head, straight ahead at its
/// centre: it needs no texture coordinates, has no seam on the face, and is evaluated at rest, so that paint sticks to skin.
#pragma once

#include <vector>

#include "risorius/render/detail/gl.h"
#include "risorius/render/scene.h"

namespace risorius::render {

class OwnTextures;
class SceneBuffers;

/// Place on the map, 0..1 each way.
Vec2 paint_place(const Vec3& rest, const Vec3& centre);

/// Middle of the map's sphere: between the tragia, or the middle of the skin.
Vec3 paint_centre(const Scene& scene, const Vec3& skin_min, const Vec3& skin_max);

/// Texels per side that a picture needs which shows this many pixels (of its own, not samples) per metre of skin.
constexpr int kMinPaintSide = 256, kMaxPaintSide = 4096;
int paint_side(double pixels_per_metre);

/// Draws the map with the vertex array of the buffers, which is bound, and these triangles of the scene.
/// Returns a mip-mapped texture: square root of linear albedo, and oil in alpha. The context must be current.
GLuint paint_skin(const Scene& scene, const SceneBuffers& buffers, const OwnTextures& own,
                  const Vec3& centre, const std::vector<unsigned>& triangles, int side);

/// A tile of pores: slopes of the surface around 0.5, repeating.
GLuint make_pores(unsigned seed);

/// sRGB 0..1 to linear.
Vec3 linear_from_srgb(const Vec3& srgb);

}  // namespace risorius::render
