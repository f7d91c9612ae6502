// SPDX-License-Identifier: MIT
/// \file
/// Samples: points of a surface at which contact is evaluated. They are its nodes and points between them, so that small
/// objects cannot pass between the nodes of a coarse grid.
#pragma once

#include <vector>

#include "risorius/core/types.h"
#include "risorius/solve/node_blend.h"

namespace risorius::contact {

/// A point of a surface, with its area.
struct ContactSample {
    solve::NodeBlend point;
    /// The part of the rest area of the surface that belongs to the sample. With 1, stiffness_pa_per_m is the stiffness of each
    /// sample, N/m.
    double area_m2 = 1;
};

/// Samples at the lattice points of every triangle. Each side of a triangle is cut into `per_side` equal parts. With 1, the
/// samples are the nodes; with 2, also the midpoints of sides; with 3, nodes, thirds of sides and centres. Samples on shared
/// corners and sides appear once. Their areas add up to the area of the surface.
std::vector<ContactSample> surface_samples(const Points& rest, const Triangles& triangles,
                                           int per_side = 1);

/// Samples at the given nodes, with the same area each.
std::vector<ContactSample> node_samples(const std::vector<int>& nodes, double area_m2 = 1);

/// The smallest `per_side` for which neighbouring samples on the rest surface are at most `spacing_m` apart.
int parts_per_side(const Points& rest, const Triangles& triangles, double spacing_m);

}  // namespace risorius::contact
