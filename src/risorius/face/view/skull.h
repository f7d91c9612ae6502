// SPDX-License-Identifier: MIT
/// \file
/// Estimates skull and mandible of a head from its skin: the bones of the standard head are warped by the landmarks and cut back to
/// where the tissue over them is as thick as the rig's table says (means of Stephan and Simpson 2008, and later).
///
/// For display only. The bone of the simulation is the layer of deep nodes in tissue_mesh.h, with the same thickness.
#pragma once

#include <vector>

#include "risorius/core/types.h"
#include "risorius/rig/head.h"
#include "risorius/rig/rig_description.h"

namespace risorius::face {

struct BoneSurface {
    Points vertices;      ///< V x 3, m, head frame, at rest
    Triangles triangles;  ///< counter-clockwise from outside
    std::vector<double>
        open;  ///< V, 0..1: ambient visibility, the fraction of the surroundings that other bone does not hide
};

struct Skull {
    BoneSurface cranium;   ///< with the upper jaw
    BoneSurface mandible;  ///< at rest; the mandible's motion starts here
};

/// Extracted from a grid of `step_mm` at atlas size; takes some seconds at the usual step. Works on any placed head. The teeth are those
/// of the head's mesh, if there are any.
Skull estimate_skull(const rig::Head& head, const rig::RigDescription& rig, double step_mm = 1.5);

}  // namespace risorius::face
