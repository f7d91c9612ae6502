// SPDX-License-Identifier: MIT
/// \file
/// Muscles of expression as bundles of fibres in the tissue, placed from the bands of the atlas.
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

struct MusclePlacement {
    std::vector<muscle::FibrePoint> points;
    std::vector<muscle::Fibre> fibres;
    std::vector<std::vector<Vec3>> paths;  ///< path of each fibre at rest, for drawing
    std::vector<FibreBundle> bundles;
};

MusclePlacement place_muscles(const rig::Head& head, const rig::RigDescription& rig,
                              const Shell& shell, const TissueMesh& mesh);

}  // namespace risorius::face
