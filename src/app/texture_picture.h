// The pixels of a picture that a mesh's material names.
#pragma once

#include "core/image.h"
#include "geom/polygon_mesh.h"

namespace risorius::app {

/// From its file or from within the mesh's. Throws Error naming the material's place when there is no such picture.
Image read_texture(const geom::Texture& texture);

}  // namespace risorius::app
