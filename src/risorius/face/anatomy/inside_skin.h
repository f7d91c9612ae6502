// SPDX-License-Identifier: MIT
/// \file
/// Tests whether a point lies inside the skin, and how deep bone can lie under the skin.
///
/// Where skin folds back on itself, as in the wings of the nose, a thickness that was measured elsewhere would reach through the skin on
/// the other side. There is no bone, only cartilage between two layers of skin. So the tissue must end before it reaches the other layer.
#pragma once

#include <vector>

#include "risorius/core/types.h"
#include "risorius/geom/closest_point.h"

namespace risorius::face {

/// The surface of the skin at rest, with queries for inside and depth.
class InsideSkin {
  public:
    /// `skin`: N x 3, m; `triangles`: counter-clockwise seen from outside.
    InsideSkin(const Points& skin, const Triangles& triangles);

    /// Returns whether p, m, lies on the outer side of the skin. Points whose nearest point of the skin lies on an edge, such as those
    /// beyond its border, do not count as outside.
    bool outside(const Vec3& p) const;
    /// Returns how deep the tissue may reach from the point `skin` against `direction` (unit, outwards), m: the largest depth t whose end
    /// point lies inside and has no skin nearer than t / 2. It is `wanted_m` at most and `min_m` at least.
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
