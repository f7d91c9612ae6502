// SPDX-License-Identifier: MIT
/// \file
/// Locates points in the tissue: the skin above a point, and the tetrahedron that holds it.
#pragma once

#include "risorius/core/types.h"
#include "risorius/face/anatomy/shell.h"
#include "risorius/face/anatomy/tissue_mesh.h"
#include "risorius/geom/closest_point.h"
#include "risorius/muscle/fibre_set.h"

namespace risorius::face {

class TissueLocator {
  public:
    /// Keeps references to its arguments.
    TissueLocator(const Shell& shell, const TissueMesh& mesh);

    /// Skin point, thickness and outward direction of the tissue column through a point on, over or under the skin.
    struct Column {
        Vec3 skin, outward;
        double thickness;
    };
    Column column_at(const Vec3& p) const;

    /// Weights of p in the tetrahedron that holds it, or in the nearest one when p lies outside of the tissue.
    muscle::FibrePoint embed(const Vec3& p) const;

  private:
    Eigen::Vector4d weights(long t, const Vec3& p) const;

    const Shell& shell_;
    const TissueMesh& mesh_;
    geom::SurfaceTree skin_;
    Points centres_;
};

}  // namespace risorius::face
