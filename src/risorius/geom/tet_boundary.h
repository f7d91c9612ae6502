// SPDX-License-Identifier: MIT
/// \file
/// The surface of a mesh of tetrahedra.
#pragma once

#include "risorius/core/types.h"

namespace risorius::geom {

/// The triangles that belong to one tetrahedron only, counter-clockwise from outside when all volumes are positive. They are in the order
/// of their sorted corners.
Triangles boundary_of(const Tets& tets);

}  // namespace risorius::geom
