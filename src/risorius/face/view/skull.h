// SPDX-License-Identifier: MIT
/// \file
/// Estimates the skull and the mandible of a head from its skin. The bones of the standard head are warped by the landmarks. Then they are
/// cut back to where the tissue over them is as thick as the rig's table says (means of Stephan and Simpson 2008, and later).
///
/// The estimate is for display only. The bone of the simulation is the layer of deep nodes in tissue_mesh.h, with the same thickness of
/// tissue.
#pragma once

#include <vector>

#include "risorius/core/types.h"
#include "risorius/rig/head.h"
#include "risorius/rig/rig_description.h"

namespace risorius::face {

/// The surface of a bone.
struct BoneSurface {
    Points vertices;      ///< V x 3, m, head frame, at rest
    Triangles triangles;  ///< counter-clockwise from outside
    /// V, 0..1, ambient visibility: the fraction of the surroundings that bone does not hide.
    std::vector<double> open;
};

/// The two bones.
struct Skull {
    BoneSurface cranium;   ///< with the upper jaw
    BoneSurface mandible;  ///< at rest; FacePose::mandible moves it
};

/// Extracts the surfaces from a grid with the spacing `step_mm`, mm, at the size of the standard head. It takes some seconds at the default
/// spacing. The teeth are those of the head's mesh, if there are any.
Skull estimate_skull(const rig::Head& head, const rig::RigDescription& rig, double step_mm = 1.5);

}  // namespace risorius::face
