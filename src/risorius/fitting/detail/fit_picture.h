// SPDX-License-Identifier: MIT
/// \file
/// Draws a picture of the result of a fit: given and estimated landmarks, lids, mouth and eyes from the front and the side,
/// tissue thickness as colour, and the estimated bone.
#pragma once

#include <vector>

#include "risorius/core/image.h"
#include "risorius/face/anatomy/shell.h"
#include "risorius/geom/polygon_mesh.h"
#include "risorius/rig/head.h"
#include "risorius/rig/rig_description.h"

namespace risorius::fitting {

/// The estimated surface of the bone at rest. It has a point of bone for every point of the coarse skin. Positions are in m.
struct BoneEstimate {
    Points skin, bone;                ///< N x 3
    Triangles triangles;              ///< the same for both surfaces
    std::vector<double> thickness_m;  ///< N
    /// N, fraction of the mandible's motion: 1 on the mandible, 0 on the skull
    std::vector<double> jaw_fraction;
};
BoneEstimate bone_estimate(const rig::Head& head, const rig::RigDescription& rig,
                           const face::Shell& shell);

/// Thickness of the tissue between skin and bone.
struct BoneFigures {
    double thinnest_mm = 0, thickest_mm = 0, mean_mm = 0;  ///< tissue thickness over the nodes
    int through_skin = 0;  ///< number of bone points that do not lie inside the skin
};
BoneFigures bone_figures(const BoneEstimate& bone);

/// Draws the picture.
Image fit_picture(const rig::Head& head, const BoneEstimate& bone, const rig::RigDescription& rig,
                  const geom::PolygonMesh& mesh);

}  // namespace risorius::fitting
