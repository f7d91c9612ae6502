// SPDX-License-Identifier: MIT
/// \file
/// A solid of cells on meshes finer than its description's grid, whose cells are the roots: what holds it and its weight,
/// for any mesh of an adaptive solid.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "risorius/softbody/body_description.h"
#include "risorius/solve/motion_system.h"
#include "risorius/tissue/cell_solid.h"

namespace risorius::softbody {

/// Nodes of `mesh` in the part of the body the selections pick from its root grid. The part is made of whole root nodes,
/// edges, faces and cells, those with all their corners picked by one selection; so it is the same on every mesh.
std::vector<char> held_nodes(const std::vector<NodeSelection>& selections,
                             const tissue::CellMesh& mesh);

/// Throws Error unless the description is of a solid of cells without springs, pulses or obstacles.
void check_refinable(const BodyDescription& description);

/// The solid with its weight, drag and fixed nodes; `also_fixed` are held too. A system serves one mesh.
solve::MotionSystem refined_system(const BodyDescription& description,
                                   const std::shared_ptr<tissue::CellSolid>& solid,
                                   const std::vector<NodeSelection>& also_fixed = {});

/// The boundary of the body over its vertices, hanging ones included.
struct CellBoundary {
    Triangles surface;                      ///< outward
    std::vector<std::array<int, 2>> wires;  ///< edges of the cells that lie in it
};
CellBoundary boundary_of(const tissue::CellMesh& mesh);

/// Mean position of one end of the body, over material area, m. `axis` 0..2; the end where its coordinate is 0 or 1.
Vec3 face_centre(const tissue::CellSolid& solid, const Points& x, int axis, bool last);

}  // namespace risorius::softbody
