// SPDX-License-Identifier: MIT
/// \file
/// Points of a surface at which contact is evaluated: its nodes, and points between them, so that objects smaller than a cell
/// do not pass through a coarse grid.
#pragma once

#include <vector>

#include "risorius/core/types.h"
#include "risorius/solve/node_blend.h"

namespace risorius::contact {

/// A point of a surface, with its area.
struct ContactSample {
    solve::NodeBlend point;
    /// Its part of the rest area; 1: the stiffness of a contact is given per sample, N/m.
    double area_m2 = 1;
};

/// Lattice points of every triangle, whose sides are each cut into `per_side` parts (1: nodes; 2: and midpoints of sides; 3:
/// and centres). Points on shared corners and sides appear once. Their areas add up to the area of the surface.
std::vector<ContactSample> surface_samples(const Points& rest, const Triangles& triangles,
                                           int per_side = 1);

/// Only the nodes.
std::vector<ContactSample> node_samples(const std::vector<int>& nodes, double area_m2 = 1);

/// The smallest `per_side` for which gaps between samples on the rest surface are at most `spacing_m`.
int parts_per_side(const Points& rest, const Triangles& triangles, double spacing_m);

}  // namespace risorius::contact
