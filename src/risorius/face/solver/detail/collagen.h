// SPDX-License-Identifier: MIT
/// \file
/// The collagen of a face: the regions of the rig, laid into the tetrahedra of the tissue.
#pragma once

#include <vector>

#include "risorius/face/anatomy/shell.h"
#include "risorius/face/anatomy/tissue_mesh.h"
#include "risorius/rig/head.h"
#include "risorius/tissue/collagen_tets.h"

namespace risorius::face {

/// Returns the fibres of each tetrahedron in each region; none for a rig without regions. A direction is that between two landmarks,
/// made parallel to the skin of the tetrahedron. Tetrahedra whose skin is at right angles to it have no fibres.
std::vector<tissue::CollagenFibres> place_collagen(const rig::Head& head,
                                                   const std::vector<rig::CollagenRegion>& regions,
                                                   const TissueMesh& mesh);

}  // namespace risorius::face
