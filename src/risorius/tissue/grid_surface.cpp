// SPDX-License-Identifier: MIT
#include "risorius/tissue/grid_surface.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "risorius/core/cross_matrix.h"

namespace risorius::tissue {

namespace {

using Tangents = Eigen::Matrix<double, 3, 2>;

/// Sum of coefficients times rows of x.
template <int kMax>
Vec3 difference(const int (&node)[kMax], const double (&coefficient)[kMax], int count,
                const Points& x) {
    Vec3 sum = Vec3::Zero();
    for (int k = 0; k < count; ++k) sum += coefficient[k] * x.row(node[k]).transpose();
    return sum;
}

/// The unit normal and its derivatives by the tangents.
struct Normal {
    double length;  ///< |N|, N = t_1 x t_2
    Vec3 n;
    Mat3 dn[2];  ///< dn/dt_k

    explicit Normal(const Tangents& t) {
        const Vec3 product = t.col(0).cross(t.col(1));
        length = product.norm();
        n = product / length;
        const Mat3 across = (Mat3::Identity() - n * n.transpose()) / length;
        dn[0] = -across * cross_matrix(t.col(1));
        dn[1] = across * cross_matrix(t.col(0));
    }
};

/// Second derivative of e . n(t_1, t_2) for constant e, 3 x 3 block (a, b).
struct NormalCurvature {
    Mat3 block[2][2];

    NormalCurvature(const Tangents& t, const Normal& normal, const Vec3& e) {
        const Vec3& n = normal.n;
        const double en = e.dot(n), length = normal.length;
        const Vec3 slope = (e - en * n) / length;  // derivative by N
        const Mat3 by_product = (3 * en * n * n.transpose() - en * Mat3::Identity() -
                                 e * n.transpose() - n * e.transpose()) /
                                (length * length);
        const Mat3 dproduct[2] = {-cross_matrix(t.col(1)), cross_matrix(t.col(0))};
        for (int a = 0; a < 2; ++a)
            for (int b = 0; b < 2; ++b)
                block[a][b] = dproduct[a].transpose() * by_product * dproduct[b];
        block[0][1] -= cross_matrix(slope);
        block[1][0] += cross_matrix(slope);
    }
};

}  // namespace

GridSurfaceTerm::GridSurfaceTerm(const GridSurface& surface) : rest_(surface.rest) {
    add_metric_elements(surface);
    add_bending_elements(surface);
}

void GridSurfaceTerm::add_metric_elements(const GridSurface& surface) {
    const SurfaceGrid& grid = surface.grid;
    const Mat2 weights = metric_weights(grid, surface.parameters);
    for (int i = 0; i < grid.m; ++i)
        for (int j = 0; j < grid.n; ++j) {
            MetricElements::Element element;
            const int self = grid.index(i, j);
            element.node[element.count++] = self;
            const auto add_forward = [&](int axis, int neighbour) {
                element.d[axis][0] = -1 / grid.spacing(axis);
                element.d[axis][element.count] = 1 / grid.spacing(axis);
                element.node[element.count++] = neighbour;
            };
            if (i < grid.links(0)) add_forward(0, grid.index(i + 1, j));
            if (j < grid.links(1)) add_forward(1, grid.index(i, (j + 1) % grid.n));
            if (element.count == 1) continue;
            const SurfaceMaterial& material = material_of(surface, self);
            element.eta = material.elastic_n_per_m3.cwiseProduct(weights);
            element.phi = material.damping_ns_per_m3.cwiseProduct(weights);
            metric_.add(element, surface.rest);
        }
}

void GridSurfaceTerm::add_bending_elements(const GridSurface& surface) {
    const SurfaceGrid& grid = surface.grid;
    const Mat2 weights = bending_weights(grid, surface.bending);
    // The node beside (i, j) along an axis; -1 beyond the border.
    const auto beside = [&](int i, int j, int axis, int step) {
        if (axis == 0) return i + step >= 0 && i + step < grid.m ? grid.index(i + step, j) : -1;
        if (grid.closed) return grid.index(i, (j + step + grid.n) % grid.n);
        return j + step >= 0 && j + step < grid.n ? grid.index(i, j + step) : -1;
    };
    for (int i = 0; i < grid.m; ++i)
        for (int j = 0; j < grid.n; ++j) {
            const int self = grid.index(i, j);
            const Mat2 zeta = material_of(surface, self).bending_n_per_m.cwiseProduct(weights);
            for (int axis = 0; axis < 2; ++axis) {
                const int before = beside(i, j, axis, -1), after = beside(i, j, axis, 1);
                if (before < 0 || after < 0 || !(zeta(axis, axis) > 0)) continue;
                const double h = grid.spacing(axis);
                Bending element;
                element.count = 3;
                element.zeta = zeta(axis, axis);
                const int along[3] = {before, self, after};
                for (int k = 0; k < 3; ++k) {
                    element.node[k] = along[k];
                    element.second[k] = (k == 1 ? -2 : 1) / (h * h);
                    element.t[axis][k] = (k - 1) / (2 * h);
                }
                // The other tangent: one-sided at a border.
                const int other = 1 - axis;
                const int low = beside(i, j, other, -1), high = beside(i, j, other, 1);
                const double span = (low < 0 || high < 0 ? 1 : 2) * grid.spacing(other);
                for (const auto& [node, sign] : {std::pair(low, -1), std::pair(high, 1)}) {
                    if (node < 0) {
                        element.t[other][1] = sign / span;
                        continue;
                    }
                    element.node[element.count] = node;
                    element.t[other][element.count++] = sign / span;
                }
                add_bending(surface.rest, element);
            }
            if (i < grid.links(0) && j < grid.links(1) && zeta(0, 1) > 0) {
                const int right = (j + 1) % grid.n;
                const int cell[4] = {self, grid.index(i + 1, j), grid.index(i, right),
                                     grid.index(i + 1, right)};
                Bending element;
                element.count = 4;
                element.zeta = zeta(0, 1) + zeta(1, 0);
                for (int k = 0; k < 4; ++k) {
                    const double along[2] = {k % 2 ? 1.0 : -1.0, k / 2 ? 1.0 : -1.0};
                    element.node[k] = cell[k];
                    element.second[k] = along[0] * along[1] / (grid.spacing(0) * grid.spacing(1));
                    for (int axis = 0; axis < 2; ++axis)
                        element.t[axis][k] = along[axis] / (2 * grid.spacing(axis));
                }
                add_bending(surface.rest, element);
            }
        }
}

void GridSurfaceTerm::add_bending(const Points& rest, Bending element) {
    Tangents t;
    for (int k = 0; k < 2; ++k)
        t.col(k) = difference(element.node, element.t[k], element.count, rest);
    const Vec3 second = difference(element.node, element.second, element.count, rest);
    Mat3 frame;
    frame << t, t.col(0).cross(t.col(1)).normalized();
    const Vec3 c = frame.inverse() * second;

    // Rounding errors of an evenly spaced flat shape do not count as curvature.
    double scale = 0;
    for (int k = 0; k < element.count; ++k)
        scale += std::abs(element.second[k]) * rest.row(element.node[k]).norm();
    constexpr double kRoundOff = 1e-13;
    const auto counts = [&](double size) { return size > kRoundOff * scale; };
    element.normal = counts(std::abs(c[2])) ? c[2] : 0;
    for (int k = 0; k < 2; ++k)
        if (counts(std::abs(c[k]) * t.col(k).norm()))
            for (int node = 0; node < element.count; ++node)
                element.second[node] -= c[k] * element.t[k][node];
    bending_.push_back(element);
}

double GridSurfaceTerm::bending_energy(const Points& x) const {
    Points ignored = Points::Zero(x.rows(), 3);
    return add_bending_gradient(x, ignored);
}

double GridSurfaceTerm::add_bending_gradient(const Points& x, Points& gradient) const {
    double energy = 0;
    for (const Bending& element : bending_) {
        Vec3 e = difference(element.node, element.second, element.count, x);
        Tangents by_t = Tangents::Zero();
        if (element.normal != 0) {
            Tangents t;
            for (int k = 0; k < 2; ++k)
                t.col(k) = difference(element.node, element.t[k], element.count, x);
            const Normal normal(t);
            e -= element.normal * normal.n;
            for (int k = 0; k < 2; ++k)
                by_t.col(k) = -element.normal * normal.dn[k].transpose() * e;
        }
        energy += 0.5 * element.zeta * e.squaredNorm();
        for (int k = 0; k < element.count; ++k)
            gradient.row(element.node[k]) +=
                element.zeta * (element.second[k] * e + element.t[0][k] * by_t.col(0) +
                                element.t[1][k] * by_t.col(1))
                                   .transpose();
    }
    return energy;
}

void GridSurfaceTerm::add_force(double, const Points& x, const Points& v, Points& force) const {
    metric_.add_force(x, v, force);
    Points gradient = Points::Zero(x.rows(), 3);
    add_bending_gradient(x, gradient);
    force -= gradient;
}

double GridSurfaceTerm::add_potential(const solve::ImplicitStep& step, const Points& x,
                                      Points& gradient) const {
    const double energy = metric_.add_potential(step, x, gradient);
    return energy + add_bending_gradient(x, gradient);
}

void GridSurfaceTerm::add_hessian(const solve::ImplicitStep& step, const Points& x,
                                  solve::Curvature curvature,
                                  solve::HessianBuilder& hessian) const {
    metric_.add_hessian(step, x, curvature, hessian);
    for (const Bending& element : bending_) {
        if (element.normal == 0) {
            for (int k = 0; k < element.count; ++k)
                for (int l = 0; l <= k; ++l) {
                    const double w = element.zeta * element.second[k] * element.second[l];
                    if (w != 0) hessian.add(element.node[k], element.node[l], w * Mat3::Identity());
                }
            continue;
        }
        Tangents t;
        for (int k = 0; k < 2; ++k)
            t.col(k) = difference(element.node, element.t[k], element.count, x);
        const Normal normal(t);
        const Vec3 e =
            difference(element.node, element.second, element.count, x) - element.normal * normal.n;
        const NormalCurvature bent(t, normal, e);
        Mat3 de[5];
        for (int k = 0; k < element.count; ++k)
            de[k] =
                element.second[k] * Mat3::Identity() -
                element.normal * (element.t[0][k] * normal.dn[0] + element.t[1][k] * normal.dn[1]);
        for (int k = 0; k < element.count; ++k)
            for (int l = 0; l <= k; ++l) {
                Mat3 sum = de[k].transpose() * de[l];
                if (curvature == solve::Curvature::kExact)
                    for (int a = 0; a < 2; ++a)
                        for (int b = 0; b < 2; ++b)
                            sum -= element.normal * element.t[a][k] * element.t[b][l] *
                                   bent.block[a][b];
                hessian.add(element.node[k], element.node[l], element.zeta * sum);
            }
    }
}

void GridSurfaceTerm::add_metric(double step_s, solve::MetricBuilder& metric) const {
    metric_.add_metric(step_s, metric);
    for (const Bending& element : bending_) {
        if (element.normal == 0) {
            metric.add_outer(element.node, element.second, element.count, element.zeta);
            continue;
        }
        metric.add_outer(element.node, element.second, element.count, 2 * element.zeta);
        Tangents t;
        for (int k = 0; k < 2; ++k)
            t.col(k) = difference(element.node, element.t[k], element.count, rest_);
        const double w = 4 * element.zeta * element.normal * element.normal /
                         t.col(0).cross(t.col(1)).squaredNorm();
        for (int k = 0; k < 2; ++k)
            metric.add_outer(element.node, element.t[k], element.count,
                             w * t.col(1 - k).squaredNorm());
    }
}

void GridSurfaceTerm::add_secant(double, const Points& x, const Points& v, bool lag_rate,
                                 solve::MetricBuilder& K, solve::MetricBuilder&,
                                 Points& force) const {
    metric_.add_secant(x, v, lag_rate, K, force);
    for (const Bending& element : bending_) {
        K.add_outer(element.node, element.second, element.count, element.zeta);
        if (element.normal == 0) continue;
        // The force is - zeta (second - c^n dn)^T (second x - c^n n). All of it except second^T second x is explicit.
        Tangents t;
        for (int k = 0; k < 2; ++k)
            t.col(k) = difference(element.node, element.t[k], element.count, x);
        const Normal normal(t);
        const Vec3 e =
            difference(element.node, element.second, element.count, x) - element.normal * normal.n;
        for (int k = 0; k < element.count; ++k) {
            Vec3 explicit_part = element.second[k] * normal.n;
            for (int a = 0; a < 2; ++a)
                explicit_part += element.t[a][k] * normal.dn[a].transpose() * e;
            force.row(element.node[k]) += element.zeta * element.normal * explicit_part.transpose();
        }
    }
}

}  // namespace risorius::tissue
