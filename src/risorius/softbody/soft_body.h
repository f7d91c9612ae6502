// SPDX-License-Identifier: MIT
/// \file
/// A soft object ready to move: its equations of motion, the state it starts from, what is drawn and what is measured.
#pragma once

#include <array>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/softbody/body_description.h"
#include "risorius/solve/motion_system.h"
#include "risorius/tissue/solid_material.h"

namespace risorius::softbody {

struct SoftBody {
    Kind kind = Kind::kSolid;
    tissue::GridShape grid;  ///< one layer thick for surfaces, one line of nodes for curves
    Points rest;             ///< MNO x 3, m
    solve::MotionSystem
        system;  ///< its terms are shared with copies of this body: one thread at a time
    double length_scale_m = 1;  ///< longest edge of the rest shape's bounding box

    double weight_n = 0;  ///< of the whole body

    Triangles surface = {};                      ///< boundary, outward
    std::vector<std::array<int, 2>> wires = {};  ///< pairs of neighbouring nodes
    std::vector<std::array<int, 2>> edges = {};  ///< those along the edges of the rest shape
    std::vector<int> fixed = {};                 ///< rows

    /// At rest, not moving, t = 0.
    solve::MotionState start() const;

    /// Volume enclosed, cells being trilinear, m^3. This and the next are for solids.
    double volume(const Points& x) const;
    /// The thesis' sum over nodes of dV, of forward differences, whatever the discretisation, m^3.
    double volume_element_sum(const Points& x) const;
};

/// Throws Error as grid_solid does.
SoftBody build_body(const BodyDescription& description);

}  // namespace risorius::softbody
