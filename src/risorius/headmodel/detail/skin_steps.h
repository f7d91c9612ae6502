// SPDX-License-Identifier: MIT
/// \file
/// Takes steps out of the skin of a person. Many parameters at rare values can add up to a shelf at the angle of the jaw or to dents
/// in a cheek, though each handle alone is gentle. Where the displacement from a head without them changes steeply along the skin, it is
/// spread over a wider neighbourhood: with the area A, the graph Laplacian L of the skin and the width h of each vertex, the new
/// displacement minimises  sum of A |D' - D|^2 / h^2 + D'^T L D'. Where it changes gently, h is next to nothing and D' = D. Lids,
/// nose, lips and ears stay as they are: their forms are small on purpose.
#pragma once

#include "risorius/geom/polygon_mesh.h"

namespace risorius::headmodel {

/// `usual`: the head from which displacements count. Both have the topology and roughly the places of the average head, mm; only the
/// positions of the group "skin" in `mesh` change.
void ease_steps(const geom::PolygonMesh& usual, geom::PolygonMesh& mesh);

}  // namespace risorius::headmodel
