// SPDX-License-Identifier: MIT
/// \file
/// The strands on a lock of hair, as a texture that can be repeated.
#pragma once

#include "risorius/render/detail/gl.h"
#include "risorius/render/scene.h"

namespace risorius::render {

/// Makes the texture: strands run along y. Red: brightness, 0.5 on average; green: the share of white hairs. The context must be
/// current.
GLuint make_strand_texture(unsigned seed, double white_share);

}  // namespace risorius::render
