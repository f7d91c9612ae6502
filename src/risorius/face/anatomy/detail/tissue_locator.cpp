// SPDX-License-Identifier: MIT
#include "risorius/face/anatomy/detail/tissue_locator.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace risorius::face {

TissueLocator::TissueLocator(const Shell& shell, const TissueMesh& mesh)
    : shell_(shell), mesh_(mesh) {
    Points skin(static_cast<long>(shell.vertex.size()), 3);
    for (long v = 0; v < skin.rows(); ++v)
        skin.row(v) = mesh.nodes.row(node_of(static_cast<int>(v), kSkin));
    skin_ = geom::SurfaceTree(skin, shell.triangles);
    centres_.resize(mesh.tets.rows(), 3);
    for (long t = 0; t < mesh.tets.rows(); ++t) {
        centres_.row(t).setZero();
        for (int k = 0; k < 4; ++k) centres_.row(t) += 0.25 * mesh.nodes.row(mesh.tets(t, k));
    }
}

TissueLocator::Column TissueLocator::column_at(const Vec3& p) const {
    const geom::SurfacePoint foot = *skin_.closest(p);
    Column out{foot.point, Vec3::Zero(), 0};
    for (int k = 0; k < 3; ++k) {
        const int v = shell_.triangles(foot.triangle, k);
        out.outward += foot.barycentric[k] * mesh_.direction[v];
        out.thickness += foot.barycentric[k] * mesh_.thickness_m[v];
    }
    out.outward.normalize();
    return out;
}

muscle::FibrePoint TissueLocator::embed(const Vec3& p) const {
    double best_outside = 1e300;
    long best_tet = 0;
    Eigen::Vector4d best_weights;
    for (long t = 0; t < mesh_.tets.rows(); ++t) {
        const double far = (centres_.row(t).transpose() - p).squaredNorm();
        if (far > 4e-4) continue;
        const Eigen::Vector4d w = weights(t, p);
        // Distance outside, m: minimum weight times the size of the tet.
        const double outside =
            -std::min(0.0, w.minCoeff()) * std::sqrt(far) + (w.minCoeff() < 0 ? far : 0.0);
        if (outside < best_outside) {
            best_outside = outside;
            best_tet = t;
            best_weights = w;
        }
        if (w.minCoeff() >= 0) break;
    }
    if (best_outside > 1e299) {
        double min = 1e300;
        for (long t = 0; t < mesh_.tets.rows(); ++t) {
            const double far = (centres_.row(t).transpose() - p).squaredNorm();
            if (far < min) {
                min = far;
                best_tet = t;
            }
        }
        best_weights = weights(best_tet, p);
    }
    best_weights = best_weights.cwiseMax(0.0);
    best_weights /= best_weights.sum();
    muscle::FibrePoint point;
    point.count = 4;
    for (int k = 0; k < 4; ++k) {
        point.nodes[k] = mesh_.tets(best_tet, k);
        point.weights[k] = best_weights[k];
    }
    return point;
}

Eigen::Vector4d TissueLocator::weights(long t, const Vec3& p) const {
    const Vec3 a = mesh_.nodes.row(mesh_.tets(t, 0));
    Mat3 edges;
    for (int k = 0; k < 3; ++k)
        edges.col(k) = mesh_.nodes.row(mesh_.tets(t, k + 1)).transpose() - a;
    const Vec3 b = edges.inverse() * (p - a);
    return Eigen::Vector4d(1 - b.sum(), b[0], b[1], b[2]);
}

}  // namespace risorius::face
