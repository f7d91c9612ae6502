// SPDX-License-Identifier: MIT
#include "risorius/tissue/triangle_sheet.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "risorius/core/dense_algebra.h"
#include "risorius/tissue/detail/hinge_angle.h"
#include "risorius/tissue/detail/sheet_edges.h"

namespace risorius::tissue {

namespace {

using Flat = Eigen::Matrix<double, 2, 3>;  ///< three points in a plane, one per column

using detail::EdgeSide;
using detail::point;

HingeCorners corners_of(const int (&node)[4], const Points& x) {
    return {point(x, node[0]), point(x, node[1]), point(x, node[2]), point(x, node[3])};
}

/// A triangle of the rest shape in its own plane, with the first edge along x.
Flat flattened(const Vec3& p, const Vec3& q, const Vec3& r) {
    const Vec3 e1 = q - p, e2 = r - p;
    const double length = e1.norm();
    Flat flat = Flat::Zero();
    flat(0, 1) = length;
    flat(0, 2) = e2.dot(e1) / length;
    flat(1, 2) = e1.cross(e2).norm() / length;
    return flat;
}

/// Coefficients of 1/2 x . b x at a point, by (b_11, b_22, sqrt2 b_12).
Vec3 height_by_curvature(const Vec2& x) {
    return {0.5 * x[0] * x[0], 0.5 * x[1] * x[1], x[0] * x[1] / std::numbers::sqrt2};
}

/// Converts (b_11, b_22, sqrt2 b_12) by x to the same by a, where x = J a: b_a = J^T b_x J.
Mat3 curvature_change(const Mat2& J) {
    Mat3 P;
    for (int k = 0; k < 3; ++k) {
        Mat2 b = Mat2::Zero();
        if (k < 2) b(k, k) = 1;
        if (k == 2) b(0, 1) = b(1, 0) = 1 / std::numbers::sqrt2;
        const Mat2 c = J.transpose() * b * J;
        P.col(k) << c(0, 0), c(1, 1), std::numbers::sqrt2 * c(0, 1);
    }
    return P;
}

}  // namespace

TriangleSheetTerm::TriangleSheetTerm(const TriangleSurface& surface) {
    for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t) {
        const Flat a = coordinates_of(surface, t);
        Mat2 edges;
        edges << a.col(1) - a.col(0), a.col(2) - a.col(0);
        const Mat2 inverse = edges.inverse();
        const double area = area_of(a);
        MetricElements::Element element;
        element.count = 3;
        for (int k = 0; k < 3; ++k) element.node[k] = surface.triangles(t, k);
        for (int i = 0; i < 2; ++i) {
            element.d[i][1] = inverse(0, i);
            element.d[i][2] = inverse(1, i);
            element.d[i][0] = -inverse(0, i) - inverse(1, i);
        }
        const SurfaceMaterial& material = material_of(surface, t);
        element.eta = area * material.elastic_n_per_m3;
        element.phi = area * material.damping_ns_per_m3;
        metric_.add(element, surface.rest);
    }
    add_bends(surface);
}

// Makes the hinges of the inner edges. Returns the hinge of each edge of each triangle.
auto TriangleSheetTerm::find_hinges(const TriangleSurface& surface)
    -> std::vector<std::array<EdgeOf, 3>> {
    const Triangles& triangles = surface.triangles;
    std::vector<std::array<EdgeOf, 3>> edges_of(static_cast<std::size_t>(triangles.rows()));
    for (const auto& sides : detail::inner_edges(triangles)) {
        const EdgeSide& first = sides[0];
        const EdgeSide& second = sides[1];
        Hinge hinge;
        hinge.node[0] = triangles(first.triangle, first.edge);
        hinge.node[1] = triangles(first.triangle, (first.edge + 1) % 3);
        hinge.node[2] = triangles(first.triangle, (first.edge + 2) % 3);
        hinge.node[3] = triangles(second.triangle, (second.edge + 2) % 3);
        const HingeCorners x = corners_of(hinge.node, surface.rest);
        hinge.rest = hinge_angle(x);
        // On the flattened pair, each opposite corner folds by its height divided by its distance from the edge.
        const Vec3 e = x[1] - x[0];
        for (int side = 0; side < 2; ++side) {
            const Vec3 d = x[static_cast<std::size_t>(2 + side)] - x[0];
            const double distance = e.cross(d).norm() / e.norm();
            const double along = d.dot(e) / e.squaredNorm();
            hinge.height[2 + side] = -1 / distance;
            hinge.height[0] += (1 - along) / distance;
            hinge.height[1] += along / distance;
        }
        // The second triangle runs along the edge in the other direction, unless the orientation of the mesh changes here.
        const bool turned = triangles(second.triangle, second.edge) == hinge.node[0];
        const int index = static_cast<int>(hinges_.size());
        edges_of[static_cast<std::size_t>(first.triangle)][static_cast<std::size_t>(first.edge)] = {
            index, 1};
        edges_of[static_cast<std::size_t>(second.triangle)][static_cast<std::size_t>(second.edge)] =
            {index, turned ? -1.0 : 1.0};
        hinges_.push_back(hinge);
    }
    return edges_of;
}

void TriangleSheetTerm::add_bends(const TriangleSurface& surface) {
    const Triangles& triangles = surface.triangles;
    triangle_count_ = static_cast<int>(triangles.rows());
    const std::vector<std::array<EdgeOf, 3>> edges_of = find_hinges(surface);
    for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
        const Mat2& zeta = material_of(surface, t).bending_n_per_m;
        if (!(zeta.maxCoeff() > 0)) continue;
        Vec3 p[3];
        for (int k = 0; k < 3; ++k) p[k] = point(surface.rest, triangles(t, k));
        const Flat x = flattened(p[0], p[1], p[2]);
        const Flat a = coordinates_of(surface, t);
        Mat2 x_edges, a_edges;
        x_edges << x.col(1) - x.col(0), x.col(2) - x.col(0);
        a_edges << a.col(1) - a.col(0), a.col(2) - a.col(0);
        const Mat3 P = curvature_change(x_edges * a_edges.inverse());
        const Vec3 stiffness(zeta(0, 0), zeta(1, 1), zeta(0, 1));
        // A direction without stiffness gets a very small one, so that the matrix can be inverted.
        constexpr double kMinStiffness = 1e-6;
        const Mat3 C = area_of(a) * P.transpose() *
                       stiffness.cwiseMax(kMinStiffness * stiffness.maxCoeff()).asDiagonal() * P;

        Bend bend;
        bend.triangle = static_cast<int>(t);
        Eigen::Matrix<double, Eigen::Dynamic, 3, 0, 3, 3> B(0, 3);
        Vec3 signs = Vec3::Ones();
        for (int k = 0; k < 3; ++k) {
            const EdgeOf& edge = edges_of[static_cast<std::size_t>(t)][static_cast<std::size_t>(k)];
            if (edge.hinge < 0) continue;
            const Hinge& hinge = hinges_[static_cast<std::size_t>(edge.hinge)];
            // The neighbour's corner, unfolded into this triangle's plane.
            const int opposite =
                hinge.node[2] == triangles(t, (k + 2) % 3) ? hinge.node[3] : hinge.node[2];
            const Vec2 from = x.col(k), along = (x.col((k + 1) % 3) - x.col(k)).normalized();
            const Vec2 outward(along[1], -along[0]);
            const Vec3 edge3 = (p[(k + 1) % 3] - p[k]).normalized();
            const Vec3 d = point(surface.rest, opposite) - p[k];
            const Vec2 q = from + d.dot(edge3) * along + edge3.cross(d).norm() * outward;

            const auto fold_of = [&](const Vec2& corner) -> Vec3 {
                const Vec2 r = corner - from;
                const double length = (x.col((k + 1) % 3) - from).norm();
                const double fraction = r.dot(along) / length;
                const double distance = std::abs(r.dot(outward));
                return (height_by_curvature(corner) - (1 - fraction) * height_by_curvature(from) -
                        fraction * height_by_curvature(x.col((k + 1) % 3))) /
                       distance;
            };
            B.conservativeResize(bend.count + 1, 3);
            B.row(bend.count) = -(fold_of(q) + fold_of(x.col((k + 2) % 3))).transpose();
            signs[bend.count] = edge.sign;
            bend.hinge[bend.count++] = edge.hinge;
        }
        if (bend.count == 0) continue;
        // Minimum energy 1/2 kappa C kappa with B kappa = theta: 1/2 theta (B C^-1 B^T)^-1 theta. The eigenvalues get a lower
        // bound, because folds that are nearly dependent (six corners near one conic) would make it infinitely stiff.
        constexpr double kMinFraction = 1e-3;
        using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>;
        const Small compliance = B * C.inverse() * B.transpose();
        const SymmetricEigen eigen = symmetric_eigen(compliance);
        const double min = kMinFraction * eigen.values.maxCoeff();
        const Small vectors = eigen.vectors;
        const Small Q =
            vectors * eigen.values.cwiseMax(min).cwiseInverse().asDiagonal() * vectors.transpose();
        for (int e = 0; e < bend.count; ++e)
            for (int f = 0; f < bend.count; ++f) bend.Q(e, f) = signs[e] * signs[f] * Q(e, f);
        const Small by_fold = P * C.inverse() * B.transpose() * Q;
        for (int e = 0; e < bend.count; ++e) {
            bend.curvature.col(e) = signs[e] * by_fold.col(e);
            bend.curvature(2, e) /= std::numbers::sqrt2;
        }
        bends_.push_back(bend);
    }
}

double TriangleSheetTerm::fold(const Points& x, Eigen::VectorXd& moment) const {
    Eigen::VectorXd change(static_cast<Eigen::Index>(hinges_.size()));
    for (std::size_t h = 0; h < hinges_.size(); ++h)
        change[static_cast<Eigen::Index>(h)] =
            hinge_angle(corners_of(hinges_[h].node, x)) - hinges_[h].rest;
    moment.setZero(change.size());
    double energy = 0;
    for (const Bend& bend : bends_)
        for (int e = 0; e < bend.count; ++e) {
            double sum = 0;
            for (int f = 0; f < bend.count; ++f) sum += bend.Q(e, f) * change[bend.hinge[f]];
            moment[bend.hinge[e]] += sum;
            energy += 0.5 * change[bend.hinge[e]] * sum;
        }
    return energy;
}

std::vector<Vec3> TriangleSheetTerm::curvatures(const Points& x) const {
    std::vector<Vec3> curvature(static_cast<std::size_t>(triangle_count_), Vec3::Zero());
    for (const Bend& bend : bends_)
        for (int e = 0; e < bend.count; ++e) {
            const Hinge& hinge = hinges_[static_cast<std::size_t>(bend.hinge[e])];
            curvature[static_cast<std::size_t>(bend.triangle)] +=
                (hinge_angle(corners_of(hinge.node, x)) - hinge.rest) * bend.curvature.col(e);
        }
    return curvature;
}

double TriangleSheetTerm::bending_energy(const Points& x) const {
    Eigen::VectorXd moment;
    return fold(x, moment);
}

double TriangleSheetTerm::energy(double, const Points& x) const {
    return metric_.energy(x) + bending_energy(x);
}

double TriangleSheetTerm::add_bending_gradient(const Points& x, Points& gradient) const {
    if (bends_.empty()) return 0;
    Eigen::VectorXd moment;
    const double energy = fold(x, moment);
    for (std::size_t h = 0; h < hinges_.size(); ++h) {
        const double m = moment[static_cast<Eigen::Index>(h)];
        if (m == 0) continue;
        const auto slope = hinge_angle_gradient(corners_of(hinges_[h].node, x));
        for (std::size_t k = 0; k < 4; ++k)
            gradient.row(hinges_[h].node[k]) += m * slope[k].transpose();
    }
    return energy;
}

void TriangleSheetTerm::add_force(double, const Points& x, const Points& v, Points& force) const {
    metric_.add_force(x, v, force);
    Points gradient = Points::Zero(x.rows(), 3);
    add_bending_gradient(x, gradient);
    force -= gradient;
}

double TriangleSheetTerm::add_potential(const solve::ImplicitStep& step, const Points& x,
                                        Points& gradient) const {
    const double energy = metric_.add_potential(step, x, gradient);
    return energy + add_bending_gradient(x, gradient);
}

void TriangleSheetTerm::add_hessian(const solve::ImplicitStep& step, const Points& x,
                                    solve::Curvature curvature,
                                    solve::HessianBuilder& hessian) const {
    metric_.add_hessian(step, x, curvature, hessian);
    if (bends_.empty()) return;
    std::vector<std::array<Vec3, 4>> slope;
    slope.reserve(hinges_.size());
    for (const Hinge& hinge : hinges_)
        slope.push_back(hinge_angle_gradient(corners_of(hinge.node, x)));

    for (const Bend& bend : bends_) {
        // Folds share corners: gather them first, then add each pair of nodes once.
        std::array<int, 12> node{};
        std::array<std::array<Vec3, 3>, 12> by_node;
        std::size_t count = 0;
        for (int e = 0; e < bend.count; ++e) {
            const Hinge& hinge = hinges_[static_cast<std::size_t>(bend.hinge[e])];
            for (std::size_t k = 0; k < 4; ++k) {
                std::size_t at = 0;
                while (at < count && node[at] != hinge.node[k]) ++at;
                if (at == count) {
                    node[count] = hinge.node[k];
                    by_node[count++] = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
                }
                by_node[at][static_cast<std::size_t>(e)] +=
                    slope[static_cast<std::size_t>(bend.hinge[e])][k];
            }
        }
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t j = 0; j <= i; ++j) {
                Mat3 sum = Mat3::Zero();
                for (int e = 0; e < bend.count; ++e)
                    for (int f = 0; f < bend.count; ++f)
                        sum += bend.Q(e, f) * by_node[i][static_cast<std::size_t>(e)] *
                               by_node[j][static_cast<std::size_t>(f)].transpose();
                hessian.add(node[i], node[j], sum);
            }
    }
    if (curvature == solve::Curvature::kPositive) return;
    Eigen::VectorXd moment;
    fold(x, moment);
    for (std::size_t h = 0; h < hinges_.size(); ++h) {
        const double m = moment[static_cast<Eigen::Index>(h)];
        if (m == 0) continue;
        const auto block = hinge_angle_hessian(corners_of(hinges_[h].node, x));
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = 0; j <= i; ++j)
                hessian.add(hinges_[h].node[i], hinges_[h].node[j], m * block[i][j]);
    }
}

template <class Visit>
void TriangleSheetTerm::for_each_bending_mode(const Visit& visit) const {
    for (const Bend& bend : bends_) {
        const Eigen::SelfAdjointEigenSolver<Mat3> eigen(bend.Q);
        for (int mode = 0; mode < 3; ++mode) {
            const double w = eigen.eigenvalues()[mode];
            if (!(w > 0)) continue;
            int node[12];
            double coefficient[12];
            int count = 0;
            for (int e = 0; e < bend.count; ++e)
                for (int k = 0; k < 4; ++k) {
                    const Hinge& hinge = hinges_[static_cast<std::size_t>(bend.hinge[e])];
                    node[count] = hinge.node[k];
                    coefficient[count++] = eigen.eigenvectors()(e, mode) * hinge.height[k];
                }
            visit(node, coefficient, count, w);
        }
    }
}

void TriangleSheetTerm::add_metric(double step_s, solve::MetricBuilder& metric) const {
    metric_.add_metric(step_s, metric);
    for_each_bending_mode([&](const int* node, const double* coefficient, int count, double w) {
        metric.add_outer(node, coefficient, count, w);
    });
}

void TriangleSheetTerm::add_secant(double, const Points& x, const Points& v, bool lag_rate,
                                   solve::MetricBuilder& K, solve::MetricBuilder&,
                                   Points& force) const {
    metric_.add_secant(x, v, lag_rate, K, force);
    Points gradient = Points::Zero(x.rows(), 3);
    add_bending_gradient(x, gradient);
    force -= gradient;
    for_each_bending_mode([&](const int* node, const double* coefficient, int count, double w) {
        K.add_outer(node, coefficient, count, w);
        Vec3 height = Vec3::Zero();
        for (int k = 0; k < count; ++k) height += coefficient[k] * point(x, node[k]);
        for (int k = 0; k < count; ++k)
            force.row(node[k]) += w * coefficient[k] * height.transpose();
    });
}

}  // namespace risorius::tissue
