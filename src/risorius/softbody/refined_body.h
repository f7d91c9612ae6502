// SPDX-License-Identifier: MIT
/// \file
/// A solid of cells on meshes that are finer than its description's grid; the cells of that grid are the root cells. This file
/// gives the fixed nodes and the weight for any mesh of an adaptive solid.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "risorius/softbody/body_description.h"
#include "risorius/solve/motion_system.h"
#include "risorius/tissue/cell_solid.h"

namespace risorius::softbody {

/// Flags the nodes of `mesh` in the part of the body that the selections pick from the root grid. The part consists of whole
/// root nodes, edges, faces and cells: those whose corners are all picked by one selection. So it is the same on every mesh.
std::vector<char> held_nodes(const std::vector<NodeSelection>& selections,
                             const tissue::CellMesh& mesh);

/// Throws Error unless the description is of a solid of cells without springs, pulses and obstacles.
void check_refinable(const BodyDescription& description);

/// The solid with its weight, drag and fixed nodes, including those of `also_fixed`. A system serves one mesh.
solve::MotionSystem refined_system(const BodyDescription& description,
                                   const std::shared_ptr<tissue::CellSolid>& solid,
                                   const std::vector<NodeSelection>& also_fixed = {});

/// The boundary of the body over its vertices, hanging ones included.
struct CellBoundary {
    Triangles surface;                      ///< facing outward
    std::vector<std::array<int, 2>> wires;  ///< edges of cells on the boundary
};
CellBoundary boundary_of(const tissue::CellMesh& mesh);

/// Mean position of one end of the body, m, weighted by material area. `axis` is 0..2; the end is where its coordinate is 0, or
/// 1 with `last`.
Vec3 face_centre(const tissue::CellSolid& solid, const Points& x, int axis, bool last);

}  // namespace risorius::softbody
