// SPDX-License-Identifier: MIT
/// \file
/// Measures of a displaced surface: its stretch, and its symmetry.
#pragma once

#include <optional>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/geom/mirror.h"

namespace risorius::blendshapes {

/// Principal stretches of triangles, ratios of length.
struct Stretch {
    double max = 1, min = 1;
    double max_of_99 = 1;  ///< not exceeded by 99 % of the area
};

/// The stretch from `rest` to `moved`. Triangles with almost no area at rest are ignored.
Stretch stretch_of(const Triangles& triangles, const Points& rest, const Points& moved);

/// The mirror partners of the vertices of a symmetric head; empty for others.
std::optional<geom::MirrorPairs> mirror_of(const Triangles& skin, const Points& rest);

/// Largest distance, m, between one displacement and the mirror image of the other, over the skin vertices.
double asymmetry_m(const geom::MirrorPairs& mirror, const Points& one, const Points& other);

/// Replaces `field` at vertices with a partner: by the mirror image of `other`, or by the mean of itself and that.
Points with_mirror_image(const geom::MirrorPairs& mirror, const Points& field, const Points& other);
Points mean_with_mirror_image(const geom::MirrorPairs& mirror, const Points& field,
                              const Points& other);

}  // namespace risorius::blendshapes
