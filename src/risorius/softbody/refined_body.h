// SPDX-License-Identifier: MIT
/// \file
/// A solid of cells on a mesh that is finer than the grid of its description. The cells of that grid are the root cells of the
/// mesh. The functions here return the fixed nodes and the system for any mesh of an adaptive solid.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "risorius/softbody/body_description.h"
#include "risorius/solve/motion_system.h"
#include "risorius/tissue/cell_solid.h"

namespace risorius::softbody {

/// Returns one flag per node of `mesh`, true for nodes in the part of the body that `selections` select on the root grid. This
/// part consists of the nodes, edges, faces and cells of the root grid whose corners are all selected by one selection. So it
/// is the same on every mesh.
std::vector<char> held_nodes(const std::vector<NodeSelection>& selections,
                             const tissue::CellMesh& mesh);

/// Throws Error unless the description is of a solid of cells without springs, pulses and obstacles.
void check_refinable(const BodyDescription& description);

/// Returns the system of the solid, with its weight, drag and fixed nodes, including those of `also_fixed`. A system is valid
/// for one mesh.
solve::MotionSystem refined_system(const BodyDescription& description,
                                   const std::shared_ptr<tissue::CellSolid>& solid,
                                   const std::vector<NodeSelection>& also_fixed = {});

/// The boundary of the body. Indices are those of the vertices of the mesh, hanging ones included.
struct CellBoundary {
    Triangles surface;                      ///< facing outward
    std::vector<std::array<int, 2>> wires;  ///< edges of cells on the boundary
};
CellBoundary boundary_of(const tissue::CellMesh& mesh);

/// Mean position of one end of the body, m, weighted by area in material coordinates. At this end, the material coordinate
/// `axis` (0, 1 or 2) is 0, or 1 when `last` is true.
Vec3 face_centre(const tissue::CellSolid& solid, const Points& x, int axis, bool last);

}  // namespace risorius::softbody
