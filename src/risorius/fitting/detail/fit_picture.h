// SPDX-License-Identifier: MIT
/// \file
/// Picture of the result of a fit: landmarks given and estimated, lids, mouth and eyes from the front and the side, thickness of the tissue
/// as colour, and the estimated bone.
#pragma once

#include <vector>

#include "risorius/core/image.h"
#include "risorius/face/anatomy/shell.h"
#include "risorius/geom/polygon_mesh.h"
#include "risorius/rig/head.h"
#include "risorius/rig/rig_description.h"

namespace risorius::fitting {

/// The estimated bone under the tissue at rest: one point of bone under every point of the coarse skin, m.
struct BoneEstimate {
    Points skin, bone;                ///< N x 3
    Triangles triangles;              ///< over both
    std::vector<double> thickness_m;  ///< N
    std::vector<double>
        jaw_fraction;  ///< N, fraction of the mandible's motion: 1 on the mandible, 0 on the skull
};
BoneEstimate bone_estimate(const rig::Head& head, const rig::RigDescription& rig,
                           const face::Shell& shell);

/// Thickness of the tissue between skin and bone.
struct BoneFigures {
    double thinnest_mm = 0, thickest_mm = 0, mean_mm = 0;  ///< tissue between them, at the nodes
    int through_skin = 0;  ///< nodes of bone that are not inside of the skin
};
BoneFigures bone_figures(const BoneEstimate& bone);

Image fit_picture(const rig::Head& head, const BoneEstimate& bone, const rig::RigDescription& rig,
                  const geom::PolygonMesh& mesh);

}  // namespace risorius::fitting
