// SPDX-License-Identifier: MIT
/// \file
/// Places the muscles of expression in the tissue as bundles of fibres, along the bands of the rig's muscle table.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/tissue_mesh.h"
#include "risorius/muscle/fibre_set.h"
#include "risorius/rig/head.h"
#include "risorius/rig/rig_description.h"

namespace risorius::face {

/// The rigid bodies that muscles and contacts can be attached to.
enum BodyIndex { kSkullBody = 0, kMandibleBody = 1, kBodies = 2 };

/// The parallel fibres of one band of a muscle.
struct FibreBundle {
    std::string muscle;
    std::optional<Side> side;  ///< empty: the muscle crosses the midline
    int column = 0;            ///< of the activation vector
    int first_fibre = 0, fibre_count = 0;
    double width_m = 0;
    bool origin_on_bone = false, insertion_on_bone = false;
};

/// All bundles of a face.
struct MusclePlacement {
    std::vector<muscle::FibrePoint> points;  ///< of all fibres
    std::vector<muscle::Fibre> fibres;
    std::vector<std::vector<Vec3>> paths;  ///< path of each fibre at rest, m, for drawing
    std::vector<FibreBundle> bundles;
};

/// Leaves out volume muscles.
MusclePlacement place_muscles(const rig::Head& head, const rig::RigDescription& rig,
                              const Shell& shell, const TissueMesh& mesh);

}  // namespace risorius::face
