// SPDX-License-Identifier: MIT
#include "risorius/face/anatomy/detail/tissue_locator.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace risorius::face {

namespace {

Lip side_of(const Shell& shell, int vertex) {
    return shell.over_bite_m[static_cast<std::size_t>(vertex)] >= 0 ? Lip::kUpper : Lip::kLower;
}

// Returns the triangles of the shell whose corners are all above the bite, or all below it; all when there are none.
Triangles on_side_of(const Shell& shell, Lip lip) {
    Triangles out(shell.triangles.rows(), 3);
    long rows = 0;
    for (long f = 0; f < shell.triangles.rows(); ++f) {
        bool on_side = true;
        for (int k = 0; k < 3; ++k) on_side &= side_of(shell, shell.triangles(f, k)) == lip;
        if (on_side) out.row(rows++) = shell.triangles.row(f);
    }
    return rows > 0 ? Triangles(out.topRows(rows)) : shell.triangles;
}

}  // namespace

Lip lip_of(const std::string& landmark) {
    const std::string name = landmark.substr(0, landmark.find('_'));
    for (const char* upper : {"ls", "stos", "ulc", "cph", "mp", "sn"})
        if (name == upper) return Lip::kUpper;
    for (const char* lower : {"li", "stoi", "llc", "sl"})
        if (name == lower) return Lip::kLower;
    return Lip::kNone;
}

TissueLocator::TissueLocator(const rig::Head& head, const Shell& shell, const TissueMesh& mesh)
    : shell_(shell),
      mesh_(mesh),
      middle_x_(0.5 * (head.landmark("ch_l").x() + head.landmark("ch_r").x())),
      quarter_m_(0.25 * (head.landmark("ch_l").x() - head.landmark("ch_r").x())) {
    Points skin(static_cast<long>(shell.vertex.size()), 3);
    for (long v = 0; v < skin.rows(); ++v)
        skin.row(v) = mesh.nodes.row(node_of(static_cast<int>(v), kSkin));
    const auto skin_of = [&](Triangles triangles) {
        return Skin{triangles, geom::SurfaceTree(skin, triangles)};
    };
    skin_ = skin_of(shell.triangles);
    upper_skin_ = skin_of(on_side_of(shell, Lip::kUpper));
    lower_skin_ = skin_of(on_side_of(shell, Lip::kLower));
    centres_.resize(mesh.tets.rows(), 3);
    for (long t = 0; t < mesh.tets.rows(); ++t) {
        centres_.row(t).setZero();
        for (int k = 0; k < 4; ++k) centres_.row(t) += 0.25 * mesh.nodes.row(mesh.tets(t, k));
    }
}

TissueLocator::Column TissueLocator::column_at(const Vec3& p, Lip lip) const {
    const Skin& skin = !owned(p, lip) ? skin_ : lip == Lip::kUpper ? upper_skin_ : lower_skin_;
    const geom::SurfacePoint foot = *skin.tree.closest(p);
    Column out{foot.point, Vec3::Zero(), 0};
    for (int k = 0; k < 3; ++k) {
        const int v = skin.triangles(foot.triangle, k);
        out.outward += foot.barycentric[k] * mesh_.direction[v];
        out.thickness += foot.barycentric[k] * mesh_.thickness_m[v];
    }
    out.outward.normalize();
    return out;
}

bool TissueLocator::owned(const Vec3& p, Lip lip) const {
    return lip != Lip::kNone && std::abs(p.x() - middle_x_) < quarter_m_;
}

bool TissueLocator::on_other_lip(long tet, Lip lip) const {
    for (int k = 0; k < 4; ++k)
        if (side_of(shell_, mesh_.tets(tet, k) / kLayers) != lip) return true;
    return false;
}

muscle::FibrePoint TissueLocator::embed(const Vec3& p, Lip lip) const {
    const bool one_lip = owned(p, lip);
    double best_outside = 1e300;
    long best_tet = 0;
    Eigen::Vector4d best_weights;
    for (long t = 0; t < mesh_.tets.rows(); ++t) {
        const double far = (centres_.row(t).transpose() - p).squaredNorm();
        if (far > 4e-4 || (one_lip && on_other_lip(t, lip))) continue;
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
