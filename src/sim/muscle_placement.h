// Mimetic muscles as bundles of fibres through the tissue, placed from their bands in landmark terms.
#pragma once

#include <vector>

#include "core/types.h"
#include "muscle/fibre_set.h"
#include "rig/head.h"
#include "rig/rig_description.h"
#include "sim/tissue_mesh.h"

namespace risorius::sim {

enum BodyIndex { kSkullBody = 0, kMandibleBody = 1, kBodies = 2 };

inline constexpr double kFibreSpacing_mm = 4.0;  ///< across a band, atlas size

struct MusclePlacement {
    std::vector<muscle::FibrePoint> points;
    std::vector<muscle::Fibre> fibres;
    std::vector<std::vector<Vec3>> paths;  ///< of each fibre at rest, for drawing
};

MusclePlacement place_muscles(const rig::Head& head, const rig::RigDescription& rig,
                              const Shell& shell, const TissueMesh& mesh);

}  // namespace risorius::sim
