// SPDX-License-Identifier: MIT
/// \file
/// The box around the skin of a scene at rest.
#pragma once

#include "risorius/core/types.h"
#include "risorius/render/scene.h"

namespace risorius::render {

/// Lowest and highest coordinates, m.
struct SkinBox {
    Vec3 min = Vec3::Constant(1e9), max = Vec3::Constant(-1e9);
};

/// Throws Error when the scene has no skin. Vertices that it lacks are left to SceneBuffers, which names their place.
SkinBox box_of_skin(const Scene& scene);

}  // namespace risorius::render
