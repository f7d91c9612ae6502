// SPDX-License-Identifier: MIT
/// \file
/// Directions of fibres in a muscle of tetrahedra: those of a flow from its origin to its insertion, as of water through a pipe.
///
///   div grad p = 0 in the muscle      p = 0 at nodes of the origin, 1 at those of the insertion      no flow through other faces
///   d = grad p / |grad p|
///
/// p is linear in each tetrahedron, and d is constant. Fibres meet both ends at right angles and run along the sides. In a prism between
/// its end faces the fibres are straight, to rounding.
///
/// Source: Choi & Blemker 2013, PLoS ONE 8(10), e77576 (fascicles of skeletal muscles as such flows).
#pragma once

#include <vector>

#include "risorius/core/types.h"

namespace risorius::muscle {

/// Returns d of each tetrahedron, T x 3, unit vectors. `origin`, `insertion`: one flag per row of `rest`; no node has both. Throws
/// std::invalid_argument when a tetrahedron is not joined to both ends, and where nothing flows: in one that lies within an end.
Points fibre_flow(const Points& rest, const Tets& tets, const std::vector<char>& origin,
                  const std::vector<char>& insertion);

/// Returns grad p of each tetrahedron, T x 3, 1/m; it is 0 in a tetrahedron that lies within an end. Its length says how densely the fibres
/// lie. Throws std::invalid_argument when a tetrahedron is not joined to both ends.
Points flow_gradients(const Points& rest, const Tets& tets, const std::vector<char>& origin,
                      const std::vector<char>& insertion);

}  // namespace risorius::muscle
