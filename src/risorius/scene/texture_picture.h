// SPDX-License-Identifier: MIT
/// \file
/// Reads the picture of a texture that a material of a mesh names.
#pragma once

#include "risorius/core/image.h"
#include "risorius/geom/polygon_mesh.h"

namespace risorius::scene {

/// Reads the picture from its own file, or from the file of the mesh if it is stored there. Throws Error when there is no such
/// picture; the message names the place of the material.
Image read_texture(const geom::Texture& texture);

}  // namespace risorius::scene
