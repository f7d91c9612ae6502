// SPDX-License-Identifier: MIT
/// \file
/// Places volume muscles in a head: grids of nodes along the paths of the muscle table, and what they are attached to.
///
/// The m axis of a grid runs along the fibres from origin to insertion, n across, o from bone to skin. Several paths form one sheet. The
/// upper and the lower half of orbicularis oris share their nodes at the corners of the mouth and form one ring.
#pragma once

#include <string>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/detail/jaw.h"
#include "risorius/face/anatomy/detail/tissue_locator.h"
#include "risorius/rig/head.h"
#include "risorius/rig/rig_description.h"
#include "risorius/tissue/solid_material.h"

namespace risorius::face {

struct SolidNode {
    Vec3 rest = Vec3::Zero();   ///< m
    double jaw_fraction = 0;    ///< fraction of the mandible's motion that its bone follows
    bool on_bone = false;       ///< attached to bone
    bool soft_end = false;      ///< where the muscle takes hold of soft tissue
    bool against_bone = false;  ///< kept off the bone along `outward`
    Vec3 outward = Vec3::UnitZ();
};

struct SolidPart {
    const rig::Muscle* muscle = nullptr;
    const rig::SolidMuscle* solid = nullptr;
    Side side = Side::kLeft;
    int column = 0;   ///< of the activation vector
    double f0_n = 0;  ///< of the whole part
    tissue::GridShape grid;
    std::vector<int> node;  ///< of each grid node, in SolidPlacement::nodes
};

struct SolidPlacement {
    std::vector<SolidNode> nodes;
    std::vector<SolidPart> parts;
};

/// Pointers in the parts are into `rig`. Throws Error naming the muscle when a cell of it has no volume on this head.
SolidPlacement place_solids(const rig::Head& head, const rig::RigDescription& rig, const Jaw& jaw,
                            const TissueLocator& locator);

}  // namespace risorius::face
