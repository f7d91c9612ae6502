// SPDX-License-Identifier: MIT
#include "risorius/tissue/difference_solid.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#include "risorius/core/cross_matrix.h"
#include "risorius/core/dense_algebra.h"

namespace risorius::tissue {

namespace {

using solve::Lanes;

constexpr int kFirst[6] = {0, 1, 2, 0, 1, 2};   ///< i of the pairs 11, 22, 33, 12, 23, 31
constexpr int kSecond[6] = {0, 1, 2, 1, 2, 0};  ///< j
constexpr int kPair[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};

Lanes load_lanes(const double* from) {
    Lanes lanes;
    std::memcpy(&lanes, from, sizeof lanes);
    return lanes;
}

void store_lanes(const Lanes& lanes, double* to) { std::memcpy(to, &lanes, sizeof lanes); }

Lanes dot(const Lanes a[3], const Lanes b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

void cross(const Lanes a[3], const Lanes b[3], Lanes c[3]) {
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

/// Columns r_2 x r_3, r_3 x r_1, r_1 x r_2: the derivative of dV by the tangents.
Mat3 volume_gradient(const Mat3& r) {
    Mat3 c;
    for (int i = 0; i < 3; ++i) c.col(i) = r.col((i + 1) % 3).cross(r.col((i + 2) % 3));
    return c;
}

Mat3 without_negative(const Mat3& symmetric) {
    const Eigen::SelfAdjointEigenSolver<Mat3> eigen(symmetric);
    return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() *
           eigen.eigenvectors().transpose();
}

/// Second derivative of a node's energy by its tangents, 3 x 3 blocks [i][j].
struct TangentHessian {
    Mat3 block[3][3];

    /// `alpha` is the stress. `k` is its stiffness: alpha_ij grows by k_ij dG_ij.
    TangentHessian(const Mat3& alpha, const Mat3& k, const Mat3& r) {
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                block[i][j] =
                    alpha(i, j) * Mat3::Identity() + k(i, j) * r.col(j) * r.col(i).transpose();
        for (int i = 0; i < 3; ++i)
            for (int l = 0; l < 3; ++l) block[i][i] += k(i, l) * r.col(l) * r.col(l).transpose();
    }

    void add_volume(double psi, const Mat3& r) {
        const Mat3 c = volume_gradient(r);
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) block[i][j] += 2 * psi * c.col(i) * c.col(j).transpose();
    }

    /// Adds 2 psi D times the second derivative of dV, D = dV - dV0.
    void add_volume_curvature(double psi_d, const Mat3& r) {
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3, l = (i + 2) % 3;
            block[i][j] -= 2 * psi_d * cross_matrix(r.col(l));
            block[j][i] += 2 * psi_d * cross_matrix(r.col(l));
        }
    }
};

}  // namespace

/// r_i of four nodes: [axis][coordinate].
struct DifferenceSolid::Tangents {
    Lanes r[3][3];

    Lanes metric(int pair) const { return dot(r[kFirst[pair]], r[kSecond[pair]]); }
};

/// s_ij of four nodes, and the stress of the volume term.
struct DifferenceSolid::Stress {
    Lanes s[6] = {};
    Lanes c[3][3] = {};  ///< r_2 x r_3 and so on, times 2 psi (dV - dV0)

    /// Returns psi (dV - dV0)^2.
    Lanes add_volume(const Group& group, const Tangents& t) {
        cross(t.r[1], t.r[2], c[0]);
        cross(t.r[2], t.r[0], c[1]);
        cross(t.r[0], t.r[1], c[2]);
        const Lanes excess = dot(t.r[0], c[0]) - group.dv0;
        const Lanes q = group.psi * excess;
        for (auto& vector : c)
            for (Lanes& component : vector) component *= q + q;
        return q * excess;
    }
};

DifferenceSolid::DifferenceSolid(const GridSolid& solid, const std::string& place)
    : grid_(solid.grid), rest_(solid.rest) {
    check(solid, place);
    const int nodes = grid_.size();
    ahead_[0] = grid_.n * grid_.o;
    ahead_[1] = grid_.o;
    ahead_[2] = 1;
    const int padded = (nodes + 3) / 4 * 4;
    stride_ = padded + ahead_[0];
    q_stride_ = ahead_[0] + padded;
    x_.assign(static_cast<std::size_t>(3 * stride_), 0.0);
    v_ = x_;
    q_.assign(static_cast<std::size_t>(9 * q_stride_), 0.0);

    groups_.assign(static_cast<std::size_t>(padded / 4), Group{});
    for (int i = 0; i < grid_.m; ++i)
        for (int j = 0; j < grid_.n; ++j)
            for (int k = 0; k < grid_.o; ++k) {
                const int node = grid_.index(i, j, k);
                const SolidMaterial& material = material_of(solid, node);
                const bool independent = solid.parameters == Parameters::kResolutionIndependent;
                const Mat3 eta = independent ? per_node_tensor(material.elastic_n_per_m3, grid_)
                                             : material.elastic_n_per_m3;
                const Mat3 phi = independent ? per_node_tensor(material.damping_ns_per_m3, grid_)
                                             : material.damping_ns_per_m3;
                const bool has_next[3] = {i + 1 < grid_.m, j + 1 < grid_.n, k + 1 < grid_.o};
                const double psi = has_next[0] && has_next[1] && has_next[2]
                                       ? material.incompressibility_n_per_m5
                                       : 0.0;
                Group& group = groups_[static_cast<std::size_t>(node / 4)];
                const int lane = node % 4;
                for (int axis = 0; axis < 3; ++axis)
                    group.inverse_h[axis][lane] = has_next[axis] ? 1.0 / grid_.spacing(axis) : 0.0;
                for (int pair = 0; pair < 6; ++pair) {
                    group.eta[pair][lane] = eta(kFirst[pair], kSecond[pair]);
                    group.phi[pair][lane] = phi(kFirst[pair], kSecond[pair]);
                }
                group.psi[lane] = psi;
                damped_ = damped_ || !phi.isZero(0);
                incompressible_ = incompressible_ || psi > 0;
            }

    load(rest_, x_);
    for (int g = 0; g < static_cast<int>(groups_.size()); ++g) {
        Group& group = groups_[static_cast<std::size_t>(g)];
        const Tangents t = tangents(x_, g);
        for (int pair = 0; pair < 6; ++pair) group.g0[pair] = t.metric(pair);
        // Uses the same operations as every later call, so that the rest shape is exactly free of force.
        Lanes c[3];
        cross(t.r[1], t.r[2], c);
        group.dv0 = dot(t.r[0], c);
    }
}

void DifferenceSolid::load(const Points& x, std::vector<double>& lanes) const {
    assert(x.rows() == grid_.size());
    double* const to = lanes.data();
    const double* from = x.data();
    for (int node = 0; node < grid_.size(); ++node, from += 3) {
        to[node] = from[0];
        to[stride_ + node] = from[1];
        to[2 * stride_ + node] = from[2];
    }
}

inline DifferenceSolid::Tangents DifferenceSolid::tangents(const std::vector<double>& x,
                                                           int group) const {
    const Group& g = groups_[static_cast<std::size_t>(group)];
    Tangents t;
    for (int k = 0; k < 3; ++k) {
        const double* const here = x.data() + k * stride_ + 4 * group;
        const Lanes p = load_lanes(here);
        for (int axis = 0; axis < 3; ++axis)
            t.r[axis][k] = (load_lanes(here + ahead_[axis]) - p) * g.inverse_h[axis];
    }
    return t;
}

inline void DifferenceSolid::store(int group, const Tangents& t, const Stress& stress) const {
    const Group& g = groups_[static_cast<std::size_t>(group)];
    double* const to = q_.data() + ahead_[0] + 4 * group;
    for (int i = 0; i < 3; ++i) {
        const Lanes s0 = stress.s[kPair[i][0]], s1 = stress.s[kPair[i][1]],
                    s2 = stress.s[kPair[i][2]];
        for (int k = 0; k < 3; ++k) {
            const Lanes p = s0 * t.r[0][k] + s1 * t.r[1][k] + s2 * t.r[2][k] + stress.c[i][k];
            store_lanes(p * g.inverse_h[i], to + (3 * i + k) * q_stride_);
        }
    }
}

/// Adds backward differences of the stored values. The value before the first node of an axis is zero because the previous row
/// ends there or the padding begins. The last value of an axis is zero because 1/h is.
void DifferenceSolid::add_differences(double sign, Points& sum) const {
    assert(sum.rows() == grid_.size());
    double* to = sum.data();
    const int nodes = grid_.size();
    for (int first = 0; first < nodes; first += 4, to += 12) {
        double total[3][4];
        for (int k = 0; k < 3; ++k) {
            Lanes f{};
            for (int axis = 0; axis < 3; ++axis) {
                const double* const q = q_.data() + ahead_[0] + (3 * axis + k) * q_stride_ + first;
                f += load_lanes(q) - load_lanes(q - ahead_[axis]);
            }
            store_lanes(sign * f, total[k]);
        }
        const int count = std::min(4, nodes - first);
        for (int lane = 0; lane < count; ++lane)
            for (int k = 0; k < 3; ++k) to[3 * lane + k] += total[k][lane];
    }
}

void DifferenceSolid::add_force_parts(const Parts& parts, const Points& x, const Points& v,
                                      Points& force) const {
    const bool damping = parts.damping && damped_;
    const bool volume = parts.volume && incompressible_;
    load(x, x_);
    if (damping) load(v, v_);
    for (int g = 0; g < static_cast<int>(groups_.size()); ++g) {
        const Group& group = groups_[static_cast<std::size_t>(g)];
        const Tangents t = tangents(x_, g);
        Stress stress;
        if (parts.elastic)
            for (int pair = 0; pair < 6; ++pair)
                stress.s[pair] = group.eta[pair] * (t.metric(pair) - group.g0[pair]);
        if (damping) {
            const Tangents rate = tangents(v_, g);
            for (int pair = 0; pair < 6; ++pair) {
                const int i = kFirst[pair], j = kSecond[pair];
                stress.s[pair] +=
                    group.phi[pair] * (dot(rate.r[i], t.r[j]) + dot(t.r[i], rate.r[j]));
            }
        }
        if (volume) stress.add_volume(group, t);
        store(g, t, stress);
    }
    add_differences(1.0, force);
}

void DifferenceSolid::add_force(double, const Points& x, const Points& v, Points& force) const {
    add_force_parts({.elastic = true, .damping = true, .volume = true}, x, v, force);
}

double DifferenceSolid::energy(double, const Points& x) const {
    load(x, x_);
    Lanes sum{};
    for (int g = 0; g < static_cast<int>(groups_.size()); ++g) {
        const Group& group = groups_[static_cast<std::size_t>(g)];
        const Tangents t = tangents(x_, g);
        Lanes node{};
        for (int pair = 0; pair < 6; ++pair) {
            const Lanes strain = t.metric(pair) - group.g0[pair];
            node += (pair < 3 ? 0.25 : 0.5) * group.eta[pair] * strain * strain;
        }
        if (incompressible_) node += Stress().add_volume(group, t);
        sum += node;
    }
    return solve::sum_lanes(sum);
}

double DifferenceSolid::add_potential(const solve::ImplicitStep& step, const Points& x,
                                      Points& gradient) const {
    const double rate = step.rate_hz();
    const bool damping = damped_ && rate > 0;
    load(x, x_);
    if (damping) load(step.start, v_);
    Lanes sum{};
    for (int g = 0; g < static_cast<int>(groups_.size()); ++g) {
        const Group& group = groups_[static_cast<std::size_t>(g)];
        const Tangents t = tangents(x_, g);
        Stress stress;
        Lanes node{};
        for (int pair = 0; pair < 6; ++pair) {
            const Lanes strain = t.metric(pair) - group.g0[pair];
            stress.s[pair] = group.eta[pair] * strain;
            node += (pair < 3 ? 0.25 : 0.5) * stress.s[pair] * strain;
        }
        if (damping) {
            const Tangents start = tangents(v_, g);
            for (int pair = 0; pair < 6; ++pair) {
                const Lanes grown = t.metric(pair) - start.metric(pair);
                const Lanes s = group.phi[pair] * rate * grown;
                stress.s[pair] += s;
                node += (pair < 3 ? 0.25 : 0.5) * s * grown;
            }
        }
        if (incompressible_) node += stress.add_volume(group, t);
        sum += node;
        store(g, t, stress);
    }
    add_differences(-1.0, gradient);
    return solve::sum_lanes(sum);
}

DifferenceSolid::Node DifferenceSolid::node_at(int node) const {
    const Group& group = groups_[static_cast<std::size_t>(node / 4)];
    const int lane = node % 4;
    Node result;
    result.nodes[0] = node;
    for (int axis = 0; axis < 3; ++axis) {
        result.inverse_h[axis] = group.inverse_h[axis][lane];
        result.nodes[axis + 1] = result.inverse_h[axis] > 0 ? node + ahead_[axis] : node;
    }
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const int pair = kPair[i][j];
            result.eta(i, j) = group.eta[pair][lane];
            result.phi(i, j) = group.phi[pair][lane];
            result.g0(i, j) = group.g0[pair][lane];
        }
    result.psi = group.psi[lane];
    result.dv0 = group.dv0[lane];
    return result;
}

Mat3 DifferenceSolid::Node::tangents(const Points& x) const {
    Mat3 r;
    for (int i = 0; i < 3; ++i)
        r.col(i) = (x.row(nodes[i + 1]) - x.row(nodes[0])).transpose() * inverse_h[i];
    return r;
}

void DifferenceSolid::add_hessian(const solve::ImplicitStep& step, const Points& x,
                                  solve::Curvature curvature,
                                  solve::HessianBuilder& hessian) const {
    const double rate = step.rate_hz();
    const bool exact = curvature == solve::Curvature::kExact;
    for (int n = 0; n < grid_.size(); ++n) {
        const Node node = node_at(n);
        const Mat3 r = node.tangents(x);
        const Mat3 metric = r.transpose() * r;
        Mat3 alpha = node.eta.cwiseProduct(metric - node.g0);
        Mat3 k = node.eta;
        if (damped_ && rate > 0) {
            const Mat3 start = node.tangents(step.start);
            alpha += rate * node.phi.cwiseProduct(metric - start.transpose() * start);
            k += rate * node.phi;
        }
        TangentHessian h(exact ? alpha : without_negative(alpha), k, r);
        if (node.psi > 0) {
            h.add_volume(node.psi, r);
            if (exact) h.add_volume_curvature(node.psi * (r.determinant() - node.dv0), r);
        }

        // Derivatives by the nodes: r_i = (x[i + 1] - x[0]) / h_i.
        Mat3 own = Mat3::Zero();
        for (int i = 0; i < 3; ++i) {
            if (node.inverse_h[i] == 0) continue;
            Mat3 across = Mat3::Zero();
            for (int j = 0; j < 3; ++j) {
                if (node.inverse_h[j] == 0) continue;
                const Mat3 block = node.inverse_h[i] * node.inverse_h[j] * h.block[i][j];
                across -= block;
                own += block;
                if (j <= i) hessian.add(node.nodes[i + 1], node.nodes[j + 1], block);
            }
            hessian.add(node.nodes[i + 1], n, across);
        }
        hessian.add(n, n, own);
    }
}

void DifferenceSolid::add_metric(double step_s, solve::MetricBuilder& metric) const {
    for (int n = 0; n < grid_.size(); ++n) {
        const Node node = node_at(n);
        const Mat3 r = node.tangents(rest_);
        const Mat3 k = node.eta + node.phi / step_s;
        TangentHessian h(Mat3::Zero(), k, r);
        h.add_volume(node.psi, r);

        // The pattern: what each tangent alone would need. It is scaled by an eigenvalue so that it bounds all tangents
        // together.
        const Mat3 c = volume_gradient(r);
        Vec3 pattern = Vec3::Zero();
        for (int i = 0; i < 3; ++i) {
            if (node.inverse_h[i] == 0) continue;
            for (int j = 0; j < 3; ++j)
                pattern[i] = std::max(pattern[i], 2 * k(i, j) * node.g0(j, j));
            pattern[i] += 2 * node.psi * c.col(i).squaredNorm();
        }
        Eigen::MatrixXd scaled = Eigen::MatrixXd::Zero(9, 9);
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                if (pattern[i] > 0 && pattern[j] > 0)
                    scaled.block<3, 3>(3 * i, 3 * j) =
                        h.block[i][j] / std::sqrt(pattern[i] * pattern[j]);
        const double bound = symmetric_eigenvalues(scaled)[8];
        for (int i = 0; i < 3; ++i) {
            if (!(pattern[i] > 0)) continue;
            const int pair[2] = {n, node.nodes[i + 1]};
            const double difference[2] = {-node.inverse_h[i], node.inverse_h[i]};
            metric.add_outer(pair, difference, 2, bound * pattern[i]);
        }
    }
}

void DifferenceSolid::add_secant(double, const Points& x, const Points& v, bool lag_rate,
                                 solve::MetricBuilder& K, solve::MetricBuilder&,
                                 Points& force) const {
    for (int n = 0; n < grid_.size(); ++n) {
        const Node node = node_at(n);
        const Mat3 r = node.tangents(x);
        Mat3 s = node.eta.cwiseProduct(r.transpose() * r - node.g0);
        if (lag_rate && damped_) {
            const Mat3 rate = node.tangents(v);
            s += node.phi.cwiseProduct(rate.transpose() * r + r.transpose() * rate);
        }
        // Force on the nodes = - W s W^T x with the differences W.
        for (int i = 0; i < 3; ++i) {
            if (node.inverse_h[i] == 0) continue;
            for (int j = 0; j <= i; ++j) {
                if (node.inverse_h[j] == 0) continue;
                const double w = node.inverse_h[i] * node.inverse_h[j] * s(i, j);
                const int ends[3] = {n, node.nodes[i + 1], node.nodes[j + 1]};
                if (i == j) {
                    const double block[4] = {w, -w, -w, w};
                    K.add_block(ends, block, 2);
                } else {
                    // (x_i - x_0)(x_j - x_0) and its transpose
                    const double block[9] = {2 * w, -w, -w, -w, 0, w, -w, w, 0};
                    K.add_block(ends, block, 3);
                }
            }
        }
    }
    add_force_parts({.elastic = false, .damping = !lag_rate, .volume = true}, x, v, force);
}

double DifferenceSolid::volume_element_sum(const Points& x) const {
    double sum = 0;
    for (int n = 0; n < grid_.size(); ++n) sum += node_at(n).tangents(x).determinant();
    return sum;
}

int DifferenceSolid::inverted_count(const Points& x) const {
    int count = 0;
    for (int n = 0; n < grid_.size(); ++n) {
        const Node node = node_at(n);
        if ((node.inverse_h.array() > 0).all() && node.tangents(x).determinant() <= 0) ++count;
    }
    return count;
}

}  // namespace risorius::tissue
