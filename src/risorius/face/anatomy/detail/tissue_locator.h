// SPDX-License-Identifier: MIT
/// \file
/// Locates points in the tissue: the skin above a point, and the tetrahedron that contains it.
#pragma once

#include "risorius/core/types.h"
#include "risorius/face/anatomy/shell.h"
#include "risorius/face/anatomy/tissue_mesh.h"
#include "risorius/geom/closest_point.h"
#include "risorius/muscle/fibre_set.h"

namespace risorius::face {

/// Queries on the tissue mesh at rest. Positions are in the head frame, m.
class TissueLocator {
  public:
    /// Keeps references to its arguments.
    TissueLocator(const Shell& shell, const TissueMesh& mesh);

    /// The column of tissue between skin and bone: its skin point, outward direction (unit) and thickness, m.
    struct Column {
        Vec3 skin, outward;
        double thickness;
    };
    /// Returns the column at the point of the skin that is nearest to p.
    Column column_at(const Vec3& p) const;

    /// Returns the four nodes and the barycentric weights of p in the tetrahedron that contains it. If p lies outside the tissue, it takes
    /// a near tetrahedron, with the weights limited to 0..1.
    muscle::FibrePoint embed(const Vec3& p) const;

  private:
    Eigen::Vector4d weights(long t, const Vec3& p) const;

    const Shell& shell_;
    const TissueMesh& mesh_;
    geom::SurfaceTree skin_;
    Points centres_;
};

}  // namespace risorius::face
