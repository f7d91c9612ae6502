// SPDX-License-Identifier: MIT
/// \file
/// The strands on a lock of hair, as a texture that can be repeated.
#pragma once

#include <cstdint>
#include <vector>

#include "risorius/render/detail/gl.h"
#include "risorius/render/scene.h"

namespace risorius::render {

/// Tone of a hair without pigment, sRGB.
inline const Vec3 kWhiteHair(0.74, 0.70, 0.64);

/// Width and height of the texture, px.
constexpr int kStrandSide = 256;

/// Returns the texture, two bytes a texel: strands run along y. Red: brightness, 0.5 on average; green: the share of white hairs.
std::vector<std::uint8_t> strand_texels(unsigned seed, double white_share);

/// Makes the texture of strand_texels(). The context must be current.
GLuint make_strand_texture(unsigned seed, double white_share);

}  // namespace risorius::render
