// SPDX-License-Identifier: MIT
/// \file
/// A soft object that is ready to move: its equations of motion, its initial state, and what is drawn and measured.
#pragma once

#include <array>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/softbody/body_description.h"
#include "risorius/solve/motion_system.h"
#include "risorius/tissue/solid_material.h"

namespace risorius::softbody {

/// The body that build_body() makes.
struct SoftBody {
    Kind kind = Kind::kSolid;
    tissue::GridShape grid;  ///< one layer for surfaces, one line of nodes for curves
    Points rest;             ///< MNO x 3, m
    /// Copies of this body share its terms, so only one thread at a time may use them.
    solve::MotionSystem system;
    double length_scale_m = 1;  ///< longest edge of the bounding box of the rest shape

    double weight_n = 0;  ///< of the whole body

    Triangles surface = {};                      ///< boundary, facing outward
    std::vector<std::array<int, 2>> wires = {};  ///< pairs of neighbouring nodes
    std::vector<std::array<int, 2>> edges = {};  ///< wires along the edges of the rest shape
    std::vector<int> fixed = {};                 ///< rows

    /// The rest shape without velocity, t = 0.
    solve::MotionState start() const;

    /// Enclosed volume of trilinear cells, m^3. This function and the next are for solids.
    double volume(const Points& x) const;
    /// The thesis' sum over nodes of dV by forward differences, m^3, for any discretisation.
    double volume_element_sum(const Points& x) const;
};

/// Throws Error when grid_solid does.
SoftBody build_body(const BodyDescription& description);

}  // namespace risorius::softbody
