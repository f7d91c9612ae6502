// How the deep tissue is held: sliding and lifting stiffness over the bone, interpolated from landmarks; bone moves with
// skull or mandible.
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
    double jaw_weight;  ///< share of the mandible's motion its bone follows
    Vec3 floor_bulge;   ///< m for every metre that the chin comes back

    /// Where what lies at `rest` is held when the mandible has moved.
    Vec3 target(const Vec3& rest, const Rigid& moved, double chin_back_m) const {
        return rest + jaw_weight * (moved * rest - rest) + chin_back_m * floor_bulge;
    }
};

/// One per shell vertex that is not fixed.
std::vector<Attachment> place_attachments(const rig::Head& head, const rig::RigDescription& rig,
                                          const Jaw& jaw, const Shell& shell,
                                          const TissueMesh& mesh);

}  // namespace risorius::face
