// SPDX-License-Identifier: MIT
/// \file
/// Points of a surface at which it feels contact: its nodes, and points between them so that a coarse grid does not swallow
/// what is smaller than a cell.
#pragma once

#include <vector>

#include "risorius/core/types.h"
#include "risorius/solve/node_blend.h"

namespace risorius::contact {

struct ContactSample {
    solve::NodeBlend point;
    double area_m2 =
        1;  ///< it stands for, at rest; with 1 the stiffness of a contact is meant per sample, N/m
};

/// Lattice points of every triangle, each side cut into `per_side` parts (1: nodes; 2: and mid-sides; 3: and centres), those
/// on shared corners and sides once. Their areas sum up to the surface's.
std::vector<ContactSample> surface_samples(const Points& rest, const Triangles& triangles,
                                           int per_side = 1);

/// The nodes alone.
std::vector<ContactSample> node_samples(const std::vector<int>& nodes, double area_m2 = 1);

/// Parts per side that leave no gap between samples wider than `spacing_m` on the surface at rest.
int parts_per_side(const Points& rest, const Triangles& triangles, double spacing_m);

}  // namespace risorius::contact
