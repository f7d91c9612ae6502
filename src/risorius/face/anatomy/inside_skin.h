// Whether points of bone lie inside of the skin, and how deep under it they can.
//
// Where skin folds on itself, as in the wings of the nose, a thickness measured elsewhere reaches through to the skin on
// the other side. There is no bone there but cartilage between two skins: tissue ends before the other one.
#pragma once

#include <vector>

#include "risorius/core/types.h"
#include "risorius/geom/closest_point.h"

namespace risorius::face {

class InsideSkin {
  public:
    /// `skin` N x 3, m, wound as seen from outside.
    InsideSkin(const Points& skin, const Triangles& triangles);

    /// Away from the skin on its outer side. Beside the border of the skin there is no outside.
    bool outside(const Vec3& p) const;
    /// The greatest depth along `direction`, unit and outwards, not over `wanted_m`, at which no other skin is as near as half
    /// of it; not below `least_m`.
    double depth(const Vec3& skin, const Vec3& direction, double wanted_m, double least_m) const;
    /// Outwards, unit, mean of the triangles around a skin vertex.
    const Vec3& normal(int vertex) const { return normal_[static_cast<std::size_t>(vertex)]; }

  private:
    Points skin_;
    Triangles triangles_;
    geom::SurfaceTree tree_;
    std::vector<Vec3> normal_;
};

}  // namespace risorius::face
