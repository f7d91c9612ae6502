// SPDX-License-Identifier: MIT
/// \file
/// The pixels of a picture that a mesh's material names.
#pragma once

#include "risorius/core/image.h"
#include "risorius/geom/polygon_mesh.h"

namespace risorius::scene {

/// From its file or from within the mesh's. Throws Error naming the material's place when there is no such picture.
Image read_texture(const geom::Texture& texture);

}  // namespace risorius::scene
