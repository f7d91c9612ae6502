// SPDX-License-Identifier: MIT
/// \file
/// A soft object that is ready to move: its equations of motion, its initial state, and the data for drawing and measuring it.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/muscle/fibre_tets.h"
#include "risorius/softbody/body_description.h"
#include "risorius/solve/motion_system.h"
#include "risorius/tissue/coordinate_guides.h"
#include "risorius/tissue/hyperelastic_tets.h"
#include "risorius/tissue/solid_material.h"

namespace risorius::softbody {

/// The body that build_body() makes.
struct SoftBody {
    Kind kind = Kind::kSolid;
    tissue::GridShape
        grid;     ///< one layer for surfaces, one line of nodes for curves; 0 x 0 x 0 for a mesh
    Points rest;  ///< MNO x 3, m
    /// Copies of this body share its terms, so only one thread at a time may use them.
    solve::MotionSystem system;
    double length_scale_m = 1;  ///< longest edge of the bounding box at rest, m

    double weight_n = 0;  ///< of the whole body, N

    Triangles surface = {};                      ///< boundary, facing outward
    std::vector<std::array<int, 2>> wires = {};  ///< pairs of neighbouring nodes
    std::vector<std::array<int, 2>> edges = {};  ///< wires along the edges of the rest shape
    std::vector<int> fixed = {};                 ///< indices of the fixed nodes
    /// The solid of a body that is a mesh (mesh_body.h); null for those on grids
    std::shared_ptr<const tissue::HyperelasticTets> tets = {};
    std::vector<std::shared_ptr<muscle::FibreTets>> muscles = {};  ///< of such a body

    /// Nodes of a mesh that do not move, or keep some coordinates: an entry of "fixed".
    struct Support {
        std::vector<int> nodes = {};
        std::array<bool, 3> axes{true, true, true};
        bool whole() const { return axes[0] && axes[1] && axes[2]; }
    };
    std::vector<Support> supports = {};                           ///< only of a mesh
    std::shared_ptr<const tissue::CoordinateGuides> slides = {};  ///< holds the coordinates
    /// The force with which a support holds the body at rest at x, N.
    Vec3 holding_n(const Support& support, const Points& x) const;

    /// Returns the initial state: the rest shape without velocity at t = 0.
    solve::MotionState start() const;

    /// Volume of the trilinear cells or the tetrahedra, m^3. Only for solids, as the next function.
    double volume(const Points& x) const;
    /// Sum over nodes of dV by forward differences as in the thesis (difference_solid.h), m^3, for any discretisation of a
    /// solid on a grid.
    double volume_element_sum(const Points& x) const;
};

/// Builds the body. Throws the same errors as grid_solid() and the other functions of body_description.h.
SoftBody build_body(const BodyDescription& description);

}  // namespace risorius::softbody
