// SPDX-License-Identifier: MIT
/// \file
/// Attachment of the deep tissue to bone: stiffness against sliding and lifting, interpolated from landmarks. The bone moves with skull or
/// mandible.
#pragma once

#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/detail/jaw.h"
#include "risorius/face/anatomy/tissue_mesh.h"
#include "risorius/rig/head.h"
#include "risorius/rig/rig_description.h"

namespace risorius::face {

struct Attachment {
    int shell_vertex;
    double normal_n_per_m;
    double tangential_n_per_m;
    double jaw_weight;  ///< fraction of the mandible's motion that its bone follows
    Vec3
        floor_bulge;  ///< displacement of the floor of the mouth per metre that the chin moves back

    /// Position of the attachment with rest position `rest` after this motion of the mandible, m.
    Vec3 target(const Vec3& rest, const Rigid& moved, double chin_back_m) const {
        return rest + jaw_weight * (moved * rest - rest) + chin_back_m * floor_bulge;
    }
};

/// One for each shell vertex that is not fixed.
std::vector<Attachment> place_attachments(const rig::Head& head, const rig::RigDescription& rig,
                                          const Jaw& jaw, const Shell& shell,
                                          const TissueMesh& mesh);

}  // namespace risorius::face
