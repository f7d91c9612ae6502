// SPDX-License-Identifier: MIT
/// \file
/// Places volume muscles in a head: grids of nodes along the paths of the muscle table, and the bone or soft tissue at their ends.
///
/// The axes of a grid are m along the fibres from origin to insertion, n across the fibres, and o from bone to skin.
/// Several paths form one sheet. The
/// upper and the lower half of orbicularis oris share their nodes at the corners of the mouth and form one ring.
/// A muscle with a mesh of tetrahedra has that in place of a grid (mesh_placement.h).
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

/// A node of a volume muscle.
struct SolidNode {
    Vec3 rest = Vec3::Zero();   ///< m, head frame
    double jaw_fraction = 0;    ///< fraction of the mandible's motion that its bone follows
    bool on_bone = false;       ///< attached to bone
    bool soft_end = false;      ///< at an end where the muscle inserts into soft tissue
    bool against_bone = false;  ///< kept off the bone along `outward`
    Vec3 outward = Vec3::UnitZ();
};

/// One side of a volume muscle.
struct SolidPart {
    const rig::Muscle* muscle = nullptr;
    const rig::SolidMuscle* solid = nullptr;
    Side side = Side::kLeft;
    int column = 0;          ///< of the activation vector
    double f0_n = 0;         ///< maximum isometric force of the whole part, N
    tissue::GridShape grid;  ///< of a grid
    std::vector<int>
        node;  ///< index in SolidPlacement::nodes of each node, origin first, insertion last
    /// Of a mesh, over the entries of `node`; without rows for a grid.
    Tets tets = Tets(0, 4);
    Points fibres = Points(0, 3);      ///< of each tetrahedron, unit vectors, head frame
    std::vector<double> density = {};  ///< of its fibres, see PlacedMesh::density
    std::vector<double> along = {};    ///< 0..1 of each node, on the line from origin to insertion
    double length_m = 0;               ///< of that line

    bool is_mesh() const { return tets.rows() > 0; }
};

struct SolidPlacement {
    std::vector<SolidNode> nodes;
    std::vector<SolidPart> parts;
};

/// The parts point into `rig`, which must outlive them. Throws Error with the name of the muscle when one of its cells has no volume on
/// this head.
SolidPlacement place_solids(const rig::Head& head, const rig::RigDescription& rig, const Jaw& jaw,
                            const TissueLocator& locator);

}  // namespace risorius::face
