// SPDX-License-Identifier: MIT
// How stiff the tissue is in which a volume muscle lies.
#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "risorius/face/muscle/detail/muscle_solids.h"

namespace risorius::face {

namespace {

constexpr double kBorder = -1e-6;  // a point on a face belongs to a tetrahedron on either side

/// Returns the tetrahedron that contains p; -1 outside of the tissue.
int tet_at(const Vec3& p, const Points& nodes, const Tets& tets) {
    for (int t = 0; t < static_cast<int>(tets.rows()); ++t) {
        const auto corner = [&](int k) -> Vec3 { return nodes.row(tets(t, k)).transpose(); };
        Mat3 edges;
        for (int k = 0; k < 3; ++k) edges.col(k) = corner(k + 1) - corner(0);
        if ((p - corner(0)).norm() > edges.colwise().norm().maxCoeff()) continue;
        const Vec3 inner = edges.inverse() * (p - corner(0));
        if (inner.minCoeff() >= kBorder && inner.sum() <= 1 - kBorder) return t;
    }
    return -1;
}

}  // namespace

void MuscleSolids::add_sheaths(const Points& nodes, const Tets& tets,
                               Eigen::VectorXd& mu_pa) const {
    for (const Part& part : parts_) {
        for (const int node : part.place().node) {
            if (on_bone(node)) continue;
            const int tet = tet_at(rest_.row(node).transpose(), nodes, tets);
            if (tet >= 0) mu_pa[tet] = std::max(mu_pa[tet], part.place().solid->shear_pa);
        }
    }
}

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
            const int tet = tet_at(rest_.row(node).transpose(), nodes, tissue.tets());
            if (tet < 0) continue;
            const double shear = tissue.mu_pa()[tet];
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
