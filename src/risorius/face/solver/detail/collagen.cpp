// SPDX-License-Identifier: MIT
#include "risorius/face/solver/detail/collagen.h"

#include "risorius/geom/polyline.h"

namespace risorius::face {

namespace {

constexpr double kFull = 0.8;  // of the radius: fibres within have their full stiffness

/// The middle of a tetrahedron, and the mean outward direction of its columns.
struct TetPlace {
    Vec3 centre = Vec3::Zero(), outward = Vec3::Zero();
};

TetPlace place_of(const TissueMesh& mesh, long t) {
    TetPlace out;
    for (int k = 0; k < 4; ++k) {
        out.centre += 0.25 * mesh.nodes.row(mesh.tets(t, k)).transpose();
        out.outward += mesh.direction[static_cast<std::size_t>(mesh.tets(t, k) / kLayers)];
    }
    out.outward.normalize();
    return out;
}

}  // namespace

std::vector<tissue::CollagenFibres> place_collagen(const rig::Head& head,
                                                   const std::vector<rig::CollagenRegion>& regions,
                                                   const TissueMesh& mesh) {
    std::vector<tissue::CollagenFibres> out;
    for (const rig::CollagenRegion& region : regions) {
        const Vec3 middle = head.landmark(region.at),
                   way = Vec3(head.landmark(region.to) - head.landmark(region.from)).normalized();
        const double radius = head.mm(region.radius_mm);
        for (long t = 0; t < mesh.tets.rows(); ++t) {
            const bool deep = mesh.tet_layer[static_cast<std::size_t>(t)] == kMiddle;
            if (region.layer != "both" && deep != (region.layer == "deep")) continue;
            const TetPlace tet = place_of(mesh, t);
            const double strength =
                1.0 - geom::smoothstep(kFull * radius, radius, (tet.centre - middle).norm());
            const Vec3 along = way - way.dot(tet.outward) * tet.outward;
            if (strength <= 0 || along.norm() < 0.1) continue;
            out.push_back({.tet = static_cast<int>(t),
                           .along = along.normalized(),
                           .k1_pa = strength * region.k1_pa,
                           .k2 = region.k2});
            for (int k = 0; k < 4; ++k) out.back().nodes[k] = mesh.tets(t, k);
        }
    }
    return out;
}

}  // namespace risorius::face
