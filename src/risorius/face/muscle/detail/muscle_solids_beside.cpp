// SPDX-License-Identifier: MIT
// How stiff the tissue is in which a volume muscle lies.
#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "risorius/face/muscle/detail/muscle_solids.h"

namespace risorius::face {

namespace {

constexpr double kBorder = -1e-6;  // a point on a face belongs to a tetrahedron on either side

/// Returns the shear modulus of the tetrahedron that contains p, Pa; 0 outside of the tissue.
double shear_at(const Vec3& p, const Points& nodes, const tissue::TetSolid& tissue) {
    for (int t = 0; t < tissue.size(); ++t) {
        const auto corner = [&](int k) -> Vec3 {
            return nodes.row(tissue.tets()(t, k)).transpose();
        };
        Mat3 edges;
        for (int k = 0; k < 3; ++k) edges.col(k) = corner(k + 1) - corner(0);
        if ((p - corner(0)).norm() > edges.colwise().norm().maxCoeff()) continue;
        const Vec3 inner = edges.inverse() * (p - corner(0));
        if (inner.minCoeff() >= kBorder && inner.sum() <= 1 - kBorder) return tissue.mu_pa()[t];
    }
    return 0;
}

}  // namespace

std::vector<BesideSolid> MuscleSolids::beside(const Points& nodes,
                                              const tissue::TetSolid& tissue) const {
    std::vector<BesideSolid> out;
    for (const Part& part : parts_) {
        const SolidPart& place = part.place();
        BesideSolid beside{.muscle = place.muscle->id,
                           .side = place.side,
                           .softest_pa = std::numeric_limits<double>::infinity(),
                           .muscle_pa = place.solid->shear_pa};
        double sum = 0;
        for (const int node : place.node) {
            if (on_bone(node)) continue;
            const double shear = shear_at(rest_.row(node).transpose(), nodes, tissue);
            if (shear == 0) continue;
            sum += shear;
            beside.softest_pa = std::min(beside.softest_pa, shear);
            ++beside.nodes;
        }
        if (beside.nodes > 0) beside.tissue_pa = sum / beside.nodes;
        if (beside.nodes == 0) beside.softest_pa = 0;
        out.push_back(beside);
    }
    return out;
}

}  // namespace risorius::face
