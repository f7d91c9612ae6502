// SPDX-License-Identifier: MIT
/// \file
/// Attachment of the deep tissue to bone by springs. Their stiffness against sliding and lifting is interpolated from landmarks. The bone
/// is that of the skull or the mandible, and moves with it.
#pragma once

#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/detail/jaw.h"
#include "risorius/face/anatomy/tissue_mesh.h"
#include "risorius/rig/head.h"
#include "risorius/rig/rig_description.h"

namespace risorius::face {

/// The spring between the deep node of one shell vertex and bone.
struct Attachment {
    int shell_vertex;
    double normal_n_per_m;      ///< stiffness against lifting off the bone
    double tangential_n_per_m;  ///< stiffness against sliding
    double jaw_weight;          ///< fraction of the mandible's motion that its bone follows
    /// Displacement of the floor of the mouth there per metre that the chin moves back.
    Vec3 floor_bulge;

    /// Returns where the bone end with the rest position `rest` lies, m, when the mandible has moved by `moved` from rest and the chin
    /// by `chin_back_m` backwards.
    Vec3 target(const Vec3& rest, const Rigid& moved, double chin_back_m) const {
        return rest + jaw_weight * (moved * rest - rest) + chin_back_m * floor_bulge;
    }
};

/// Returns one attachment for each shell vertex that is not fixed.
std::vector<Attachment> place_attachments(const rig::Head& head, const rig::RigDescription& rig,
                                          const Jaw& jaw, const Shell& shell,
                                          const TissueMesh& mesh);

}  // namespace risorius::face
