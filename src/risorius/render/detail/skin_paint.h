// SPDX-License-Identifier: MIT
/// \file
/// Generated skin for any head: a map painted once from the landmarks and sampled in every frame.
///
/// The map is Lambert's azimuthal equal-area projection of directions from the middle of the head, with straight ahead at its
/// centre. It needs no texture coordinates and has no seam on the face. It is evaluated at rest, so the paint sticks to the skin.
#pragma once

#include <vector>

#include "risorius/render/detail/gl.h"
#include "risorius/render/scene.h"

namespace risorius::render {

class OwnTextures;
class SceneBuffers;

/// Position on the map, 0..1 in both directions.
Vec2 paint_place(const Vec3& rest, const Vec3& centre);

/// Centre of the map's sphere: midway between the tragia, or the middle of the skin.
Vec3 paint_centre(const Scene& scene, const Vec3& skin_min, const Vec3& skin_max);

/// Texels per side for a picture that shows this many pixels (not samples) per metre of skin.
constexpr int kMinPaintSide = 256, kMaxPaintSide = 4096;
int paint_side(double pixels_per_metre);

/// Draws the map with the bound vertex array of the buffers and the given triangles of the scene. Returns a mip-mapped texture:
/// square root of linear albedo, with oil in alpha. The context must be current.
GLuint paint_skin(const Scene& scene, const SceneBuffers& buffers, const OwnTextures& own,
                  const Vec3& centre, const std::vector<unsigned>& triangles, int side);

/// A repeating tile of pores: slopes of the surface, with 0.5 for zero.
GLuint make_pores(unsigned seed);

/// sRGB 0..1 to linear.
Vec3 linear_from_srgb(const Vec3& srgb);

}  // namespace risorius::render
