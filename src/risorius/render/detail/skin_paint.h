// SPDX-License-Identifier: MIT
/// \file
/// The paint map: the colours of the skin of any head. It is painted once, from the landmarks, and sampled in every frame.
///
/// The map is Lambert's azimuthal equal-area projection of directions from the middle of the head, with straight ahead at its
/// centre. It needs no texture coordinates and has no seam on the face. It is evaluated at rest, so the paint sticks to the skin.
#pragma once

#include <cstdint>
#include <vector>

#include "risorius/render/detail/gl.h"
#include "risorius/render/scene.h"

namespace risorius::render {

class OwnTextures;
class SceneBuffers;

/// Returns the position on the map, 0..1 in both directions, of a point at rest, m. `centre`: see paint_centre().
Vec2 paint_place(const Vec3& rest, const Vec3& centre);

/// Centre of the map's sphere: midway between the tragia, or the middle of the skin.
Vec3 paint_centre(const Scene& scene, const Vec3& skin_min, const Vec3& skin_max);

/// Limits of paint_side(), which returns the texels per side of the map for a picture with the given number of pixels (not
/// samples) per metre of skin.
constexpr int kMinPaintSide = 256, kMaxPaintSide = 4096;
int paint_side(double pixels_per_metre);

/// Draws the map from the bound vertex array of the buffers and the given triangles of the scene. Returns side x side x 4 bytes, rows
/// from the bottom: rgb is the square root of the linear albedo, and alpha is the amount of oil, which makes skin glossy. The
/// context must be current.
std::vector<std::uint8_t> paint_skin(const Scene& scene, const SceneBuffers& buffers,
                                     const OwnTextures& own, const Vec3& centre,
                                     const std::vector<unsigned>& triangles, int side);

/// Makes the mip-mapped texture of a map. The context must be current.
GLuint make_paint_map(int side, const std::vector<std::uint8_t>& texels);

/// Makes a texture of pores that can be repeated. It holds the slopes of the surface in two directions, with 0.5 for zero.
GLuint make_pores(unsigned seed);

/// Converts sRGB to linear light, both 0..1.
Vec3 linear_from_srgb(const Vec3& srgb);

/// How dark a tone of skin is, 0..1: 0 for a luminance of 0.30 or more, 1 for 0.05 or less. `tone`: linear, 0..1.
double skin_darkness(const Vec3& tone);

}  // namespace risorius::render
