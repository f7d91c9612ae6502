// SPDX-License-Identifier: MIT
/// \file
/// The picture that cuts single hairs out of a ribbon of lashes, for programs that draw the ribbon as it is.
#pragma once

#include "risorius/core/image.h"
#include "risorius/core/types.h"
#include "risorius/render/scene.h"

namespace risorius::render {

/// Returns a position on the picture, from its lower left corner. Upper lashes lie in its upper half. `along`: along the lid from where the ribbon begins, 0..1. `out`: from the roots to
/// the tips, 0..1.
Vec2 lash_place(bool upper, double along, double out);

/// What of a ribbon of lashes is hair, white on black: hairs of some lengths that bend a little and thin out towards the tip.
/// `side_px`: width and height.
Image lash_opacity(int side_px);

/// Returns the place of each vertex of the scene on the picture, V x 2; (0, 0) where it is no lash. It follows from the shape of
/// the ribbons, so it serves any head.
TexCoords lash_coordinates(const Scene& scene);

}  // namespace risorius::render
