// SPDX-License-Identifier: MIT
/// \file
/// Tests whether points of bone lie inside of the skin, and how deep bone can lie under it.
///
/// Where skin folds back on itself, as in the wings of the nose, a thickness measured elsewhere would reach through to the skin on the
/// other side. There is no bone there, only cartilage between two layers of skin, so the tissue ends before the other layer.
#pragma once

#include <vector>

#include "risorius/core/types.h"
#include "risorius/geom/closest_point.h"

namespace risorius::face {

class InsideSkin {
  public:
    /// `skin` N x 3, m; triangles counter-clockwise seen from outside.
    InsideSkin(const Points& skin, const Triangles& triangles);

    /// Whether p lies on the outer side of the skin. Beyond the border of the skin nothing is outside.
    bool outside(const Vec3& p) const;
    /// The largest depth along `direction` (unit, outwards) at which no other skin is nearer than half of it, m; at most `wanted_m`, at
    /// least `min_m`.
    double depth(const Vec3& skin, const Vec3& direction, double wanted_m, double min_m) const;
    /// Outward unit normal at a skin vertex, mean of its triangles.
    const Vec3& normal(int vertex) const { return normal_[static_cast<std::size_t>(vertex)]; }

  private:
    Points skin_;
    Triangles triangles_;
    geom::SurfaceTree tree_;
    std::vector<Vec3> normal_;
};

}  // namespace risorius::face
