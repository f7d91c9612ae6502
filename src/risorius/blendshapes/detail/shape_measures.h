// What a displaced surface says about itself: how far it is stretched, and how alike its two sides are.
#pragma once

#include <optional>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/geom/mirror.h"

namespace risorius::blendshapes {

/// Ratios of length, the principal stretches of triangles.
struct Stretch {
    double greatest = 1, least = 1;
    double greatest_of_99 = 1;  ///< 99 % of the area is stretched less
};

/// Triangles with hardly any area at rest are left out.
Stretch stretch_of(const Triangles& triangles, const Points& rest, const Points& moved);

/// The mirror partners of a head that is its own mirror image, else none.
std::optional<geom::MirrorPairs> mirror_of(const Triangles& skin, const Points& rest);

/// Largest distance, m, of one displacement from the mirror image of the other, at skin vertices.
double asymmetry_m(const geom::MirrorPairs& mirror, const Points& one, const Points& other);

/// `field` at vertices that have a partner replaced by the mirror image of `other`, or by the mean of itself and that.
Points with_mirror_image(const geom::MirrorPairs& mirror, const Points& field, const Points& other);
Points mean_with_mirror_image(const geom::MirrorPairs& mirror, const Points& field,
                              const Points& other);

}  // namespace risorius::blendshapes
