// SPDX-License-Identifier: MIT
/// \file
/// Measures of a displaced surface: its stretch, and its symmetry.
#pragma once

#include <optional>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/geom/mirror.h"

namespace risorius::blendshapes {

/// Principal stretches of triangles: ratios of a length to the length at rest.
struct Stretch {
    double max = 1, min = 1;
    double max_of_99 = 1;  ///< not exceeded by 99 % of the area
};

/// Returns the stretch from `rest` to `moved`, V x 3, m. Triangles with almost no area at rest are ignored.
Stretch stretch_of(const Triangles& triangles, const Points& rest, const Points& moved);

/// Returns the pairs of vertices that are mirror images of each other; empty for a head that is not symmetric.
std::optional<geom::MirrorPairs> mirror_of(const Triangles& skin, const Points& rest);

/// Returns the largest distance, m, between the field `one` and the mirror image of the field `other`, over the vertices of the
/// skin.
double asymmetry_m(const geom::MirrorPairs& mirror, const Points& one, const Points& other);

/// These two functions return a changed copy of `field`, displacements V x 3. At vertices with a mirror partner, the first one
/// replaces `field` by the mirror image of `other`, the second one by the mean of `field` and that mirror image.
Points with_mirror_image(const geom::MirrorPairs& mirror, const Points& field, const Points& other);
Points mean_with_mirror_image(const geom::MirrorPairs& mirror, const Points& field,
                              const Points& other);

}  // namespace risorius::blendshapes
