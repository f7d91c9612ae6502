// SPDX-License-Identifier: MIT
#include "risorius/tissue/node_volumes.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <stdexcept>

namespace risorius::tissue {

namespace {

Vec3 corner_of(const Points& x, const Tets& tets, int tet, int k) {
    return x.row(tets(tet, k)).transpose();
}

double tet_volume(const Points& x, const Tets& tets, int tet) {
    const Vec3 a = corner_of(x, tets, tet, 0);
    return (corner_of(x, tets, tet, 1) - a)
               .dot((corner_of(x, tets, tet, 2) - a).cross(corner_of(x, tets, tet, 3) - a)) /
           6;
}

/// The slope of the volume by each corner, m^2.
std::array<Vec3, 4> volume_slopes(const Points& x, const Tets& tets, int tet) {
    const Vec3 a = corner_of(x, tets, tet, 0), b = corner_of(x, tets, tet, 1) - a,
               c = corner_of(x, tets, tet, 2) - a, d = corner_of(x, tets, tet, 3) - a;
    std::array<Vec3, 4> out{Vec3::Zero(), c.cross(d) / 6, d.cross(b) / 6, b.cross(c) / 6};
    out[0] = -(out[1] + out[2] + out[3]);
    return out;
}

Mat3 cross_matrix(const Vec3& v) {
    Mat3 out;
    out << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
    return out;
}

}  // namespace

NodeVolumes::NodeVolumes(const Tets& tets, const Points& rest, double bulk_pa)
    : tets_(tets), rest_(rest), bulk_pa_(bulk_pa), patches_(static_cast<std::size_t>(rest.rows())) {
    if (!(bulk_pa >= 0)) throw std::invalid_argument("NodeVolumes: a modulus below 0");
    for (int t = 0; t < static_cast<int>(tets.rows()); ++t) {
        const double volume = tet_volume(rest, tets, t);
        if (!(volume > 0)) throw std::invalid_argument("NodeVolumes: a tetrahedron without volume");
        for (int k = 0; k < 4; ++k) {
            Patch& patch = patches_[static_cast<std::size_t>(tets(t, k))];
            patch.tet.push_back(t);
            patch.volume_m3 += volume / 4;
        }
    }
    for (Patch& patch : patches_) {
        for (const int t : patch.tet)
            for (int k = 0; k < 4; ++k) patch.node.push_back(tets(t, k));
        std::sort(patch.node.begin(), patch.node.end());
        patch.node.erase(std::unique(patch.node.begin(), patch.node.end()), patch.node.end());
    }
}

Eigen::VectorXd NodeVolumes::ratios(const Points& x) const {
    Eigen::VectorXd out = Eigen::VectorXd::Zero(rest_.rows());
    for (int t = 0; t < static_cast<int>(tets_.rows()); ++t) {
        const double quarter = tet_volume(x, tets_, t) / 4;
        for (int k = 0; k < 4; ++k) out[tets_(t, k)] += quarter;
    }
    for (std::size_t a = 0; a < patches_.size(); ++a)
        if (patches_[a].volume_m3 > 0) out[static_cast<Eigen::Index>(a)] /= patches_[a].volume_m3;
    return out;
}

Eigen::VectorXd NodeVolumes::pressures_pa(const Points& x) const {
    const Eigen::VectorXd ratio = ratios(x);
    Eigen::VectorXd out = Eigen::VectorXd::Zero(tets_.rows());
    for (Eigen::Index t = 0; t < tets_.rows(); ++t)
        for (int k = 0; k < 4; ++k) out[t] += bulk_pa_ * (ratio[tets_(t, k)] - 1) / 4;
    return out;
}

double NodeVolumes::add_potential(const solve::ImplicitStep& /*step*/, const Points& x,
                                  Points& gradient) const {
    const Eigen::VectorXd ratio = ratios(x);
    double energy = 0;
    for (std::size_t a = 0; a < patches_.size(); ++a) {
        if (patches_[a].tet.empty()) continue;
        const double off = ratio[static_cast<Eigen::Index>(a)] - 1;
        energy += 0.5 * bulk_pa_ * patches_[a].volume_m3 * off * off;
    }
    for (int t = 0; t < static_cast<int>(tets_.rows()); ++t) {
        double pressure = 0;
        for (int k = 0; k < 4; ++k) pressure += bulk_pa_ * (ratio[tets_(t, k)] - 1) / 4;
        const std::array<Vec3, 4> slopes = volume_slopes(x, tets_, t);
        for (int k = 0; k < 4; ++k)
            gradient.row(tets_(t, k)) += pressure * slopes[static_cast<std::size_t>(k)].transpose();
    }
    return energy;
}

void NodeVolumes::add_hessian(const solve::ImplicitStep& /*step*/, const Points& x,
                              solve::Curvature curvature, solve::HessianBuilder& hessian) const {
    for (const Patch& patch : patches_) {
        if (patch.tet.empty()) continue;
        std::vector<Vec3> slope(patch.node.size(), Vec3::Zero());
        for (const int t : patch.tet) {
            const std::array<Vec3, 4> slopes = volume_slopes(x, tets_, t);
            for (int k = 0; k < 4; ++k) {
                const auto at = std::lower_bound(patch.node.begin(), patch.node.end(), tets_(t, k));
                slope[static_cast<std::size_t>(at - patch.node.begin())] +=
                    slopes[static_cast<std::size_t>(k)] / 4;
            }
        }
        const double stiffness = bulk_pa_ / patch.volume_m3;
        for (std::size_t i = 0; i < patch.node.size(); ++i)
            for (std::size_t j = 0; j <= i; ++j)
                hessian.add(patch.node[i], patch.node[j],
                            stiffness * slope[i] * slope[j].transpose());
    }
    if (curvature == solve::Curvature::kPositive) return;
    const Eigen::VectorXd ratio = ratios(x);
    for (int t = 0; t < static_cast<int>(tets_.rows()); ++t) {
        double pressure = 0;
        for (int k = 0; k < 4; ++k) pressure += bulk_pa_ * (ratio[tets_(t, k)] - 1) / 4;
        // 6 v = b . (c x d): the second derivative by b and c is that of b^T [..] c, and so round
        const Vec3 a = corner_of(x, tets_, t, 0);
        Mat3 blocks[4][4];
        for (auto& row : blocks)
            for (Mat3& block : row) block.setZero();
        for (int k = 1; k < 4; ++k) {
            const int next = k % 3 + 1, last = next % 3 + 1;
            const Mat3 turn = pressure / 6 * cross_matrix(corner_of(x, tets_, t, last) - a);
            blocks[k][next] = -turn;
            blocks[next][k] = turn;
        }
        for (int k = 1; k < 4; ++k)
            for (int l = 1; l < 4; ++l) {
                blocks[0][k] -= blocks[l][k];
                blocks[k][0] -= blocks[k][l];
                blocks[0][0] += blocks[k][l];
            }
        for (int k = 0; k < 4; ++k)
            for (int l = 0; l <= k; ++l) hessian.add(tets_(t, k), tets_(t, l), blocks[k][l]);
    }
}

void NodeVolumes::add_metric(double /*step_s*/, solve::MetricBuilder& metric) const {
    // The bound of single tetrahedra: the volume around a node is a mean of theirs
    for (int t = 0; t < static_cast<int>(tets_.rows()); ++t) {
        const double volume = tet_volume(rest_, tets_, t);
        const std::array<Vec3, 4> slopes = volume_slopes(rest_, tets_, t);
        Eigen::Matrix<double, 4, 4, Eigen::RowMajor> block;
        int nodes[4];
        for (int k = 0; k < 4; ++k) {
            nodes[k] = tets_(t, k);
            for (int l = 0; l < 4; ++l)
                block(k, l) =
                    bulk_pa_ / volume *
                    slopes[static_cast<std::size_t>(k)].dot(slopes[static_cast<std::size_t>(l)]);
        }
        metric.add_block(nodes, block.data(), 4);
    }
}

}  // namespace risorius::tissue
