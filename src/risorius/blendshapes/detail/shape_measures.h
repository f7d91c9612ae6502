// SPDX-License-Identifier: MIT
/// \file
/// Measures of a displaced surface: its stretch, and its symmetry.
#pragma once

#include <optional>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/geom/mirror.h"

namespace risorius::blendshapes {

/// Ratios of length, the principal stretches of triangles.
struct Stretch {
    double max = 1, min = 1;
    double max_of_99 = 1;  ///< stretch that 99 % of the area do not exceed
};

/// Leaves out triangles with almost no area at rest.
Stretch stretch_of(const Triangles& triangles, const Points& rest, const Points& moved);

/// The mirror partners of a symmetric head; empty for others.
std::optional<geom::MirrorPairs> mirror_of(const Triangles& skin, const Points& rest);

/// Largest distance, m, of one displacement from the mirror image of the other, over skin vertices.
double asymmetry_m(const geom::MirrorPairs& mirror, const Points& one, const Points& other);

/// At vertices with a partner, replaces `field` by the mirror image of `other`, or by the mean of itself and that.
Points with_mirror_image(const geom::MirrorPairs& mirror, const Points& field, const Points& other);
Points mean_with_mirror_image(const geom::MirrorPairs& mirror, const Points& field,
                              const Points& other);

}  // namespace risorius::blendshapes
