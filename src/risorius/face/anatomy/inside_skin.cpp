// SPDX-License-Identifier: MIT
#include "risorius/face/anatomy/inside_skin.h"

#include <algorithm>
#include <cmath>

namespace risorius::face {

InsideSkin::InsideSkin(const Points& skin, const Triangles& triangles)
    : skin_(skin),
      triangles_(triangles),
      tree_(skin, triangles),
      normal_(static_cast<std::size_t>(skin.rows()), Vec3::Zero()) {
    for (long f = 0; f < triangles.rows(); ++f) {
        const Vec3 a = skin.row(triangles(f, 0)), b = skin.row(triangles(f, 1)),
                   c = skin.row(triangles(f, 2));
        for (int k = 0; k < 3; ++k)
            normal_[static_cast<std::size_t>(triangles(f, k))] += (b - a).cross(c - a);
    }
    for (Vec3& n : normal_)
        if (n.norm() > 0) n.normalize();
}

bool InsideSkin::outside(const Vec3& p) const {
    const auto foot = tree_.closest(p);
    // If the nearest point lies on an edge or a corner, the side of one triangle is not decisive
    if (!foot || foot->barycentric.minCoeff() < 1e-6) return false;
    const Vec3 a = skin_.row(triangles_(foot->triangle, 0)),
               b = skin_.row(triangles_(foot->triangle, 1)),
               c = skin_.row(triangles_(foot->triangle, 2));
    return (p - foot->point).dot((b - a).cross(c - a)) > 0;
}

double InsideSkin::depth(const Vec3& skin, const Vec3& direction, double wanted_m,
                         double min_m) const {
    constexpr double kShrink = 0.9, kNearest = 0.5;
    double t = wanted_m;
    while (t > min_m) {
        const Vec3 p = skin - t * direction;
        if (!tree_.closest(p, kNearest * t) && !outside(p)) return t;
        t *= kShrink;
    }
    return std::min(wanted_m, min_m);
}

}  // namespace risorius::face
